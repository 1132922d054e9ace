// The list of all dialects, handed in from outside: the engine does not know which exist.
#pragma once

#include "language/dialect/dialect.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace feedhold {

/// All that dialects/ offers.  The first dialect is the one taken when nothing speaks for any.
struct DialectRegistry {
  std::span<const Dialect *const> dialects;
  std::span<const ForeignLanguage> foreign;
};

const Dialect *findDialect(const DialectRegistry &registry, std::string_view id);

/// What a guess rests on.
enum class GuessBasis : std::uint8_t { Nothing, Text, Neighbours };

/// What a text looks like.
struct LanguageGuess {
  const Dialect *dialect = nullptr;         // best dialect; null when `foreign` is set or nothing was recognised
  const ForeignLanguage *foreign = nullptr; // a language that is refused
  bool looksLikeProgram = false;            // false: the text is no NC program at all
  bool isNamedForMilling = false;           // by its file name or its folder
  bool hasJumps = false;                    // `IF`, `GOTO`, `WHILE`, `DO` without o-words
  bool hasCodes = false;                    // holds what only NC programs hold, not just words such as `T1 X5`
  bool namesControl = false;              // a remark, the file or its folder names the maker of a control that is read
  bool hasOwnMarks = false;               // of the dialect: a name, or what hardly any other language has
  GuessBasis basis = GuessBasis::Nothing; // Nothing: the text fits several controls alike
  std::vector<std::string_view> reasons;  // the signals that decided, strongest first
  const ForeignLanguage *kin = nullptr;   // of a program that is read: a language that it may as well be written in
  std::vector<int> scores;                // of the dialects, in their order; of a program that is read
  std::optional<GCodeSystem> gCodeSystem = {}; // of a lathe, where the text shows it
};

/// The first dialect whose score is next to the best: one weak mark does not choose.
const Dialect *likeliestDialect(std::span<const int> scores, const DialectRegistry &registry);

/// Scores a sample of the text (the first 256 KiB) by the hints of every dialect.  `path` gives the file name.
LanguageGuess guessLanguage(std::string_view text, std::string_view path, const DialectRegistry &registry);

} // namespace feedhold
