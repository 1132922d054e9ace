// Shift-JIS by its byte ranges; the table of characters is the C library's (iconv), and only this file speaks to it.
#include "base/source/shift_jis.h"

#include <array>
#include <cstdint>
#include <iconv.h>

namespace feedhold {

namespace {

constexpr std::string_view kReplacementText = "\xEF\xBF\xBD";

bool isLead(std::uint8_t byte) { return (byte >= 0x81 && byte <= 0x9F) || (byte >= 0xE0 && byte <= 0xFC); }
bool isTrail(std::uint8_t byte) { return byte >= 0x40 && byte <= 0xFC && byte != 0x7F; }
bool isKatakana(std::uint8_t byte) { return byte >= 0xA1 && byte <= 0xDF; }

std::uint8_t unitAt(std::string_view text, std::size_t at) {
  return at < text.size() ? static_cast<std::uint8_t>(text[at]) : 0;
}

/// Votes for Japanese minus votes for Latin-1, for the character at `at`.  Bytes 81 to 9F lead the kana and the common
/// kanji, and are unused in Latin-1.  From A1 up, Latin-1 has its accented letters and signs: one alone beside ASCII
/// (`45\xB0`, `L\xE4nge`) is a vote for those, several in a row are a vote for katakana or kanji.
int japaneseVote(std::string_view text, std::size_t at) {
  const std::uint8_t byte = unitAt(text, at);
  const std::uint8_t next = unitAt(text, at + 1);
  if (byte < 0x80)
    return 0;
  if (byte <= 0x9F)
    return 1;
  const bool afterHigh = at > 0 && unitAt(text, at - 1) >= 0x80;
  return next >= 0x80 || (afterHigh && isKatakana(byte)) ? 1 : -1;
}

class Converter {
public:
  Converter() : handle_(::iconv_open("UTF-8", "CP932")) {}
  Converter(const Converter &) = delete;
  Converter &operator=(const Converter &) = delete;
  ~Converter() {
    if (known())
      ::iconv_close(handle_);
  }

  /// One character.  Where the system lacks the table, every double-byte character is unknown.
  std::string convert(std::string_view character) {
    std::array<char, 8> output;
    char *in = const_cast<char *>(character.data()); // iconv's old signature; it does not write there
    char *out = output.data();
    std::size_t inLeft = character.size();
    std::size_t outLeft = output.size();
    if (!known() || ::iconv(handle_, &in, &inLeft, &out, &outLeft) == static_cast<std::size_t>(-1)) {
      reset();
      return std::string(kReplacementText);
    }
    return std::string(output.data(), out);
  }

private:
  bool known() const { return handle_ != reinterpret_cast<iconv_t>(-1); }
  void reset() {
    if (known())
      ::iconv(handle_, nullptr, nullptr, nullptr, nullptr);
  }
  iconv_t handle_;
};

} // namespace

bool isPlausibleShiftJis(std::string_view text) {
  std::int64_t votes = 0;
  for (std::size_t at = 0; at < text.size(); at += shiftJisLength(text, at)) {
    const std::uint8_t byte = unitAt(text, at);
    if (byte >= 0x80 && !isKatakana(byte) && shiftJisLength(text, at) == 1)
      return false;
    votes += japaneseVote(text, at);
  }
  return votes > 0;
}

std::size_t shiftJisLength(std::string_view text, std::size_t at) {
  return isLead(unitAt(text, at)) && isTrail(unitAt(text, at + 1)) ? 2 : 1;
}

std::string utf8FromShiftJis(std::string_view bytes) {
  Converter converter;
  std::string result;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::string_view character = bytes.substr(at, shiftJisLength(bytes, at));
    if (unitAt(character, 0) < 0x80)
      result += character;
    else
      result += converter.convert(character);
    at += character.size();
  }
  return result;
}

} // namespace feedhold
