// Path memory: what a path keeps of its movements and of indirect writes beside the variables of its state, so that
// loops and merged paths treat it like them.
#pragma once

#include <cstdint>

namespace feedhold::prove {

// Above the variables of programs and the reserved ones of contracts.

/// The free column: Z down to which the tool has cut since it came to its X and Y.  A rapid move straight down to no
/// deeper goes through what the tool has cleared, as between the pecks of a deep hole.
inline constexpr std::uint32_t kFreeColumn = 0xE0000000;

/// 1: the tool may stand beside the programmed point.  Cutter compensation has put it there, and the first movement
/// without it begins there.
inline constexpr std::uint32_t kBesidePath = 0xE0000001;

/// Vacant or not: the token of the variables that the state does not keep one by one (region_memory.h).
inline constexpr std::uint32_t kRegionToken = 0xE0000002;

inline bool isPathMemory(std::uint32_t variable) { return variable >= kFreeColumn; }

} // namespace feedhold::prove
