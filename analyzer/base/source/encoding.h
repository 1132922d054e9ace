// Encodings of program files: guessing which one a file has, and decoding it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace feedhold {

/// Latin1 is read as windows-1252, its superset on the PCs that write programs.  ShiftJis is code page 932.
enum class Encoding { Ascii, Utf8, ShiftJis, Latin1 };

/// A guess where several fit: ASCII before UTF-8 before Shift-JIS before Latin-1.
Encoding detectEncoding(std::string_view text);

/// The bytes of the character that begins at `at`, at least one: a byte that begins no character is one by itself.
std::size_t characterLength(std::string_view text, std::size_t at, Encoding encoding);

/// The beginning of the character that holds the byte `at`, in a line that begins at `lineBegin`.
std::size_t characterBegin(std::string_view text, std::size_t lineBegin, std::size_t at, Encoding encoding);

/// Bytes that do not decode become U+FFFD.
std::string toUtf8(std::string_view bytes, Encoding encoding);

void appendUtf8(std::string &text, char32_t codePoint);

} // namespace feedhold
