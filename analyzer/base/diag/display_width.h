// How many terminal cells a character takes.  Internal to diag/.
#pragma once

#include <cstdint>

namespace feedhold {

/// 0 for combining marks and invisible characters, 2 for East Asian wide and full-width ones and emoji, else 1.
std::uint32_t displayWidth(char32_t codePoint);

} // namespace feedhold
