// Tells text from binary data by its control bytes.
#include "findings/project/content.h"

#include <algorithm>

namespace feedhold {

namespace {

constexpr std::size_t kSample = std::size_t{64} * 1024;

/// Control bytes that punched-tape files and serial links leave in real programs: NUL leaders, DC1 to DC4, EOF, DEL.
bool isTapeByte(unsigned char c) { return c == 0x00 || (c >= 0x11 && c <= 0x14) || c == 0x1a || c == 0x7f; }

bool isStrange(char byte) {
  const auto c = static_cast<unsigned char>(byte);
  return c < ' ' && !isTapeByte(c) && (c < '\t' || c > '\r');
}

} // namespace

std::optional<std::string_view> whyNotText(std::string_view bytes) {
  if (bytes.find_first_not_of(" \t\r\n") == bytes.npos)
    return kEmptyFile;
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff"))
    return "UTF-16 text, which no control reads; save it as ASCII or UTF-8";
  const std::string_view sample = bytes.substr(0, kSample);
  const auto strange = static_cast<std::size_t>(std::count_if(sample.begin(), sample.end(), isStrange));
  const auto zeros = static_cast<std::size_t>(std::count(sample.begin(), sample.end(), '\0'));
  if (zeros == sample.size())
    return "nothing but NUL bytes";
  if (strange * 32 > sample.size() - zeros)
    return "a binary file";
  return std::nullopt;
}

} // namespace feedhold
