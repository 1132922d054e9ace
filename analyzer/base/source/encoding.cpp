// Recognising and walking ASCII, UTF-8, Shift-JIS and Latin-1.
#include "base/source/encoding.h"

#include "base/source/shift_jis.h"
#include "base/support/check.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace feedhold {

namespace {

constexpr char32_t kReplacement = 0xFFFD;

bool isAscii(std::string_view text) {
  constexpr std::uint64_t kHighBits = 0x8080808080808080ULL;
  constexpr std::size_t kStep = 64;
  std::size_t at = 0;
  for (; at + kStep <= text.size(); at += kStep) {
    std::array<std::uint64_t, kStep / 8> words;
    std::memcpy(words.data(), text.data() + at, kStep);
    std::uint64_t all = 0;
    for (const std::uint64_t word : words)
      all |= word;
    if ((all & kHighBits) != 0)
      return false;
  }
  return std::ranges::all_of(text.substr(at), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

std::uint8_t byteAt(std::string_view text, std::size_t at) {
  return at < text.size() ? static_cast<std::uint8_t>(text[at]) : 0;
}

bool isContinuation(std::uint8_t byte) { return (byte & 0xC0) == 0x80; }

/// The length of the well-formed sequence at `at`, 0 if there is none (Unicode standard, table 3-7).
std::size_t utf8Length(std::string_view text, std::size_t at) {
  const std::uint8_t first = byteAt(text, at);
  const std::uint8_t second = byteAt(text, at + 1);
  if (first < 0x80)
    return 1;
  if (first < 0xC2 || first > 0xF4 || !isContinuation(second))
    return 0;
  if (first < 0xE0)
    return 2;
  if (!isContinuation(byteAt(text, at + 2)))
    return 0;
  if (first < 0xF0) {
    const bool overlong = first == 0xE0 && second < 0xA0;
    const bool surrogate = first == 0xED && second > 0x9F;
    return overlong || surrogate ? 0 : 3;
  }
  const bool overlong = first == 0xF0 && second < 0x90;
  const bool tooLarge = first == 0xF4 && second > 0x8F;
  return overlong || tooLarge || !isContinuation(byteAt(text, at + 3)) ? 0 : 4;
}

bool isUtf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8Length(text, at);
    if (length == 0)
      return false;
    at += length;
  }
  return true;
}

std::string repairedUtf8(std::string_view bytes) {
  std::string result;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t length = utf8Length(bytes, at);
    if (length == 0)
      appendUtf8(result, kReplacement);
    else
      result += bytes.substr(at, length);
    at += std::max<std::size_t>(length, 1);
  }
  return result;
}

/// windows-1252, bytes 80 to 9F (WHATWG Encoding Standard, index-windows-1252; the five holes are U+FFFD here).
constexpr std::array<char32_t, 32> kWindows1252 = {
    0x20AC, 0xFFFD, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0xFFFD, 0x017D, 0xFFFD, 0xFFFD, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0xFFFD, 0x017E, 0x0178,
};

std::string utf8FromLatin1(std::string_view bytes) {
  std::string result;
  for (const char c : bytes) {
    const auto byte = static_cast<std::uint8_t>(c);
    appendUtf8(result, byte >= 0x80 && byte <= 0x9F ? kWindows1252[byte - 0x80U] : byte);
  }
  return result;
}

} // namespace

Encoding detectEncoding(std::string_view text) {
  if (isAscii(text))
    return Encoding::Ascii;
  if (isUtf8(text))
    return Encoding::Utf8;
  return isPlausibleShiftJis(text) ? Encoding::ShiftJis : Encoding::Latin1;
}

std::size_t characterLength(std::string_view text, std::size_t at, Encoding encoding) {
  switch (encoding) {
  case Encoding::Ascii:
  case Encoding::Latin1: return 1;
  case Encoding::Utf8: return std::max<std::size_t>(utf8Length(text, at), 1);
  case Encoding::ShiftJis: return shiftJisLength(text, at);
  }
  FEEDHOLD_UNREACHABLE("an encoding without a name");
}

std::size_t characterBegin(std::string_view text, std::size_t lineBegin, std::size_t at, Encoding encoding) {
  // UTF-8 is found by stepping back, which matters in a file that is one line; Shift-JIS only from the beginning of
  // the line, because a trail byte can look like a lead byte or a letter.
  std::size_t begin = lineBegin;
  if (encoding != Encoding::ShiftJis)
    begin = at - std::min<std::size_t>(at - lineBegin, encoding == Encoding::Utf8 ? 3 : 0);
  for (std::size_t next = begin; next <= at; next += characterLength(text, next, encoding))
    begin = next;
  return begin;
}

std::string toUtf8(std::string_view bytes, Encoding encoding) {
  switch (encoding) {
  case Encoding::Ascii: return std::string(bytes);
  case Encoding::Utf8: return repairedUtf8(bytes);
  case Encoding::ShiftJis: return utf8FromShiftJis(bytes);
  case Encoding::Latin1: return utf8FromLatin1(bytes);
  }
  FEEDHOLD_UNREACHABLE("an encoding without a name");
}

void appendUtf8(std::string &text, char32_t codePoint) {
  const auto push = [&](char32_t byte) { text += static_cast<char>(byte); };
  if (codePoint < 0x80) {
    push(codePoint);
    return;
  }
  if (codePoint < 0x800) {
    push(0xC0 | (codePoint >> 6));
  } else if (codePoint < 0x10000) {
    push(0xE0 | (codePoint >> 12));
    push(0x80 | ((codePoint >> 6) & 0x3F));
  } else {
    push(0xF0 | (codePoint >> 18));
    push(0x80 | ((codePoint >> 12) & 0x3F));
    push(0x80 | ((codePoint >> 6) & 0x3F));
  }
  push(0x80 | (codePoint & 0x3F));
}

} // namespace feedhold
