// The words of all languages that the guess knows; text_keywords.def lists them.
#pragma once

#include "language/dialect/text_signals.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace feedhold {

enum class KeywordKind : std::uint8_t { Plain, Signal };

struct Keyword {
  std::string_view spelling;
  KeywordKind kind;
  TextSignal signal; // of a Signal
};

/// The keyword that `run` is; null if it is none.  `run` begins with a letter.
const Keyword *findKeyword(std::string_view run);
/// The longest keyword that `run` begins with: controls read `THENGOTO` as two words.
const Keyword *longestKeywordPrefix(std::string_view run);

/// Comparison without regard to case; `upper` is in upper case.
bool equalsUpper(std::string_view text, std::string_view upper);
bool beginsUpper(std::string_view text, std::string_view upper);

template <std::size_t N> bool isOneOf(std::string_view text, const std::string_view (&upper)[N]) {
  for (const std::string_view candidate : upper)
    if (equalsUpper(text, candidate))
      return true;
  return false;
}

} // namespace feedhold
