// Shift-JIS (code page 932), the encoding of Japanese programs and comments.  Internal to source/.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace feedhold {

/// Every byte fits Shift-JIS and the characters look more like Japanese than like accented letters in Latin text.
bool isPlausibleShiftJis(std::string_view text);

/// 2 for a lead byte followed by a trail byte, else 1.
std::size_t shiftJisLength(std::string_view text, std::size_t at);

/// Bytes that do not decode become U+FFFD.
std::string utf8FromShiftJis(std::string_view bytes);

} // namespace feedhold
