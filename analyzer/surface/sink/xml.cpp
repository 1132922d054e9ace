#include "surface/sink/xml.h"

#include <algorithm>

namespace feedhold {

namespace {

constexpr std::string_view kReplacement = "\xef\xbf\xbd"; // U+FFFD, for what XML 1.0 cannot hold

/// The bytes of the UTF-8 character at the head of `text`; 0 when there is none.
std::size_t characterSize(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t size = first < 0x80   ? 1
                           : first < 0xC2 ? 0
                           : first < 0xE0 ? 2
                           : first < 0xF0 ? 3
                           : first < 0xF5 ? 4
                                          : 0;
  if (size == 0 || size > text.size())
    return 0;
  for (std::size_t i = 1; i < size; ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80)
      return 0;
  return size;
}

std::string_view escapeOf(std::string_view character) {
  switch (character.front()) {
  case '&': return "&amp;";
  case '<': return "&lt;";
  case '>': return "&gt;";
  case '"': return "&quot;";
  case '\n': return "&#10;";
  case '\r': return "&#13;";
  case '\t': return "&#9;";
  default: return static_cast<unsigned char>(character.front()) < ' ' ? kReplacement : character;
  }
}

} // namespace

std::string xml(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t size = characterSize(text);
    result += size == 0 ? kReplacement : escapeOf(text.substr(0, size));
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return result;
}

} // namespace feedhold
