// Looking keywords up by their first letter.
#include "language/dialect/text_keywords.h"

#include "base/support/text.h"

#include <array>
#include <span>

namespace feedhold {
namespace {

constexpr Keyword kKeywords[] = {
#define KEYWORD(spelling, signal) {spelling, KeywordKind::Signal, TextSignal::signal},
#define PLAIN_KEYWORD(spelling) {spelling, KeywordKind::Plain, TextSignal::HashVariable},
#include "language/dialect/text_keywords.def"
};
constexpr std::size_t kKeywordCount = std::size(kKeywords);

/// First keyword of each letter, and the end after the last.
constexpr auto kFirstByLetter = [] {
  std::array<std::uint8_t, 27> first{};
  std::size_t next = 0;
  for (std::size_t letter = 0; letter < 26; ++letter) {
    first[letter] = static_cast<std::uint8_t>(next);
    while (next < kKeywordCount && kKeywords[next].spelling.front() == static_cast<char>('A' + letter))
      ++next;
  }
  first[26] = static_cast<std::uint8_t>(next);
  return first;
}();
static_assert(kFirstByLetter[26] == kKeywordCount, "text_keywords.def is not sorted by first letter");

std::span<const Keyword> keywordsOfLetter(char letter) {
  const auto index = static_cast<std::size_t>(toUpper(letter) - 'A');
  if (index >= 26)
    return {};
  return {kKeywords + kFirstByLetter[index], kKeywords + kFirstByLetter[index + 1]};
}

} // namespace

const Keyword *findKeyword(std::string_view run) {
  for (const Keyword &keyword : keywordsOfLetter(run.front()))
    if (equalsUpper(run, keyword.spelling))
      return &keyword;
  return nullptr;
}

const Keyword *longestKeywordPrefix(std::string_view run) {
  const Keyword *best = nullptr;
  for (const Keyword &keyword : keywordsOfLetter(run.front()))
    if (beginsUpper(run, keyword.spelling) && (best == nullptr || keyword.spelling.size() > best->spelling.size()))
      best = &keyword;
  return best;
}

bool equalsUpper(std::string_view text, std::string_view upper) {
  if (text.size() != upper.size())
    return false;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (toUpper(text[i]) != upper[i])
      return false;
  return true;
}

bool beginsUpper(std::string_view text, std::string_view upper) {
  return text.size() >= upper.size() && equalsUpper(text.substr(0, upper.size()), upper);
}

} // namespace feedhold
