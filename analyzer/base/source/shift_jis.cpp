// Shift-JIS by its byte ranges.  The table of characters is ours: a C library's is a file beside it.
#include "base/source/shift_jis.h"

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace feedhold {

namespace {

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

constexpr char16_t kNone = 0xFFFD;
constexpr char16_t kFirstKatakana = 0xFF61;
constexpr char16_t kFirstOfUsers = 0xE000;
constexpr std::size_t kTrails = 188;

struct Row {
  std::uint8_t lead;
  std::u16string_view characters; // by trail byte
};

constexpr Row kRows[] = {
#define ROW(lead, characters) {lead, characters},
#include "base/source/shift_jis_table.def"
#undef ROW
};
static_assert(std::ranges::all_of(kRows, [](const Row &row) { return row.characters.size() == kTrails; }));
static_assert(std::ranges::is_sorted(kRows, {}, &Row::lead));

/// Of two bytes, as shiftJisLength() takes them together.
char16_t characterOf(std::uint8_t lead, std::uint8_t trail) {
  const std::size_t column = trail - 0x40U - (trail > 0x7F ? 1 : 0);
  if (lead >= 0xF0 && lead <= 0xF9)
    return static_cast<char16_t>(kFirstOfUsers + (lead - 0xF0) * kTrails + column);
  const Row *row = std::ranges::lower_bound(kRows, lead, {}, &Row::lead);
  return row != std::end(kRows) && row->lead == lead ? row->characters[column] : kNone;
}

/// Of all but ASCII.
std::string utf8Of(char16_t character) {
  const auto continuation = [](unsigned bits) { return static_cast<char>(0x80U | (bits & 0x3FU)); };
  const unsigned code = character;
  if (code < 0x800)
    return {static_cast<char>(0xC0U | code >> 6U), continuation(code)};
  return {static_cast<char>(0xE0U | code >> 12U), continuation(code >> 6U), continuation(code)};
}

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
  std::string result;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t length = shiftJisLength(bytes, at);
    const std::uint8_t byte = unitAt(bytes, at);
    if (length == 2)
      result += utf8Of(characterOf(byte, unitAt(bytes, at + 1)));
    else if (byte < 0x80)
      result += bytes[at];
    else
      result += utf8Of(isKatakana(byte) ? static_cast<char16_t>(kFirstKatakana + (byte - 0xA1)) : kNone);
    at += length;
  }
  return result;
}

} // namespace feedhold
