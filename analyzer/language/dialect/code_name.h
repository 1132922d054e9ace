// Codes as the manuals write them.
#pragma once

#include <cstdint>
#include <string>

namespace feedhold {

/// `G01`, `M30`, `G54.1`.  `tenths`: ten times the number.
std::string codeName(char letter, std::uint32_t tenths);

} // namespace feedhold
