// The free column: Z down to which the tool has cut since it came to its X and Y, kept beside the variables of a state.
//
// A rapid move straight down to no deeper goes through what the tool has cleared, as between the pecks of a deep hole.
#pragma once

#include <cstdint>

namespace feedhold::prove {

/// Above the variables of programs and the reserved ones of contracts.
inline constexpr std::uint32_t kFreeColumn = 0xE0000000;

} // namespace feedhold::prove
