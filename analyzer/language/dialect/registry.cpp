// Choosing a dialect: by its id, or by the signals of the text.
#include "language/dialect/registry.h"

#include "language/dialect/text_signals.h"

#include <algorithm>

namespace feedhold {
namespace {

constexpr std::size_t kSampleBytes = 256 * 1024;
constexpr std::uint32_t kMostCounted = 5; // more of the same says nothing new, and long files shall not win by length
constexpr int kForeignThreshold = 12;     // one stray word of another language does not refuse a program

int scoreOf(const TextScan &scan, std::span<const LanguageHint> hints) {
  int score = 0;
  for (const LanguageHint &hint : hints)
    score += hint.weight * static_cast<int>(std::min(scan.count(hint.signal), kMostCounted));
  return score;
}

std::vector<std::string_view> reasonsOf(const TextScan &scan, std::span<const LanguageHint> hints) {
  struct Reason {
    int score;
    std::string_view text;
  };
  std::vector<Reason> found;
  for (const LanguageHint &hint : hints) {
    const int score = hint.weight * static_cast<int>(std::min(scan.count(hint.signal), kMostCounted));
    if (score > 0)
      found.push_back({score, descriptionOf(hint.signal)});
  }
  std::stable_sort(found.begin(), found.end(), [](const Reason &a, const Reason &b) { return a.score > b.score; });
  std::vector<std::string_view> reasons;
  for (const Reason &reason : found)
    reasons.push_back(reason.text);
  return reasons;
}

template <typename Row> struct Best {
  const Row *row = nullptr;
  int score = 0;
};

/// The first of the best.
Best<Dialect> bestDialect(const TextScan &scan, const DialectRegistry &registry) {
  Best<Dialect> best;
  for (const Dialect *dialect : registry.dialects) {
    const int score = scoreOf(scan, dialect->hints);
    if (best.row == nullptr || score > best.score)
      best = {dialect, score};
  }
  return best;
}

Best<ForeignLanguage> bestForeign(const TextScan &scan, const DialectRegistry &registry) {
  Best<ForeignLanguage> best;
  for (const ForeignLanguage &foreign : registry.foreign) {
    const int score = scoreOf(scan, foreign.hints);
    if (score >= kForeignThreshold && score > best.score)
      best = {&foreign, score};
  }
  return best;
}

/// Languages with names of their own choosing have many lines that only partly speak to us.
bool hasForeignLines(const TextScan &scan) { return (scan.programLines + scan.signalLines) * 2 >= scan.otherLines; }

} // namespace

const Dialect *findDialect(const DialectRegistry &registry, std::string_view id) {
  const auto found = std::find_if(registry.dialects.begin(), registry.dialects.end(),
                                  [id](const Dialect *dialect) { return dialect->id == id; });
  return found != registry.dialects.end() ? *found : nullptr;
}

LanguageGuess guessLanguage(std::string_view text, std::string_view path, const DialectRegistry &registry) {
  const TextScan scan = scanText(text.substr(0, kSampleBytes), path);
  LanguageGuess guess;
  if (scan.isMarkup || scan.isBinary)
    return guess;
  const Best<Dialect> dialect = bestDialect(scan, registry);
  const Best<ForeignLanguage> foreign = bestForeign(scan, registry);
  if (foreign.row != nullptr && foreign.score > dialect.score && hasForeignLines(scan)) {
    guess.foreign = foreign.row;
    guess.looksLikeProgram = true;
    guess.reasons = reasonsOf(scan, foreign.row->hints);
  } else if (dialect.row != nullptr && scan.programLines > scan.otherLines) {
    guess.dialect = dialect.row;
    guess.looksLikeProgram = true;
    guess.reasons = reasonsOf(scan, dialect.row->hints);
  }
  return guess;
}

} // namespace feedhold
