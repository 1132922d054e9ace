// Choosing a dialect: by its id, or by the signals of the text.
#include "language/dialect/registry.h"

#include "language/dialect/g_code_system.h"
#include "language/dialect/text_signals.h"

#include <algorithm>

namespace feedhold {
namespace {

constexpr std::size_t kSampleBytes = std::size_t{256} * 1024;
constexpr std::uint32_t kMostCounted = 5; // more of the same says nothing new, and long files shall not win by length
constexpr int kWeakMark = 2;              // of a dialect: less than this apart is as good as equal
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

std::vector<int> scoresOf(const TextScan &scan, const DialectRegistry &registry) {
  std::vector<int> scores;
  for (const Dialect *dialect : registry.dialects)
    scores.push_back(scoreOf(scan, dialect->hints));
  return scores;
}

/// Whether the text prefers a dialect to any other one for the same kind of machine.
bool prefers(const std::vector<int> &scores, const Dialect *chosen, const DialectRegistry &registry) {
  if (chosen->machine != registry.dialects.front()->machine)
    return true; // milling is what is assumed
  const auto at = std::find(registry.dialects.begin(), registry.dialects.end(), chosen);
  const int own = scores[static_cast<std::size_t>(at - registry.dialects.begin())];
  for (std::size_t i = 0; i < scores.size(); ++i)
    if (registry.dialects[i]->machine == chosen->machine && scores[i] < own)
      return true;
  return false;
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

bool hasAny(const TextScan &scan, std::span<const TextSignal> signals) {
  return std::ranges::any_of(signals, [&scan](TextSignal signal) { return scan.count(signal) != 0; });
}

bool hasCodes(const TextScan &scan) {
  constexpr TextSignal kOwn[] = {TextSignal::ProgramNumber, TextSignal::MacroControl, TextSignal::OWord,
                                 TextSignal::MacroAlarm, TextSignal::HashVariable};
  return scan.codeLines != 0 || hasAny(scan, kOwn);
}

bool namesControl(const TextScan &scan) {
  constexpr TextSignal kNames[] = {TextSignal::FanucComment,
                                   TextSignal::FanucSeries0Comment,
                                   TextSignal::FanucSeries30Comment,
                                   TextSignal::HaasComment,
                                   TextSignal::MitsubishiComment,
                                   TextSignal::NgcComment,
                                   TextSignal::FanucName,
                                   TextSignal::HaasName,
                                   TextSignal::MitsubishiName};
  return hasAny(scan, kNames);
}

/// Words of Macro B and o-words, `M98 P` and `G65 P` are also in the languages of routers, plasma tables and robots.
bool hasOwnMarks(const TextScan &scan, const Dialect &dialect) {
  constexpr TextSignal kOfMacroB[] = {TextSignal::ProgramNumber,
                                      TextSignal::MacroAlarm,
                                      TextSignal::FanucLargeVariable,
                                      TextSignal::FanucParameterRead,
                                      TextSignal::FanucNamedVariable,
                                      TextSignal::FanucProgramName,
                                      TextSignal::FanucOffsetGroup,
                                      TextSignal::FanucFolderLine,
                                      TextSignal::FanucEncryption,
                                      TextSignal::MacroA,
                                      TextSignal::HaasLocalCall,
                                      TextSignal::HaasCode,
                                      TextSignal::HaasVariable,
                                      TextSignal::HaasSetting,
                                      TextSignal::HaasTimer,
                                      TextSignal::HaasConditionalReturn,
                                      TextSignal::MitsubishiVariable,
                                      TextSignal::MitsubishiOffsetGroup,
                                      TextSignal::MitsubishiToolOffset,
                                      TextSignal::MitsubishiParameterRead,
                                      TextSignal::EiaFile,
                                      TextSignal::TurningCycle,
                                      TextSignal::TurretTool};
  constexpr TextSignal kOfNgc[] = {TextSignal::NgcFile};
  return dialect.grammar.oWords ? hasAny(scan, kOfNgc) : hasAny(scan, kOfMacroB);
}

/// Languages with names of their own choosing have many lines that only partly speak to us.
bool hasForeignLines(const TextScan &scan) { return (scan.programLines + scan.signalLines) * 2 >= scan.otherLines; }

} // namespace

const Dialect *findDialect(const DialectRegistry &registry, std::string_view id) {
  const auto found = std::find_if(registry.dialects.begin(), registry.dialects.end(),
                                  [id](const Dialect *dialect) { return dialect->id == id; });
  return found != registry.dialects.end() ? *found : nullptr;
}

const Dialect *likeliestDialect(std::span<const int> scores, const DialectRegistry &registry) {
  const int best = *std::max_element(scores.begin(), scores.end());
  const auto likeliest =
      std::find_if(scores.begin(), scores.end(), [best](int score) { return score + kWeakMark >= best; });
  return registry.dialects[static_cast<std::size_t>(likeliest - scores.begin())];
}

LanguageGuess guessLanguage(std::string_view text, std::string_view path, const DialectRegistry &registry) {
  const TextScan scan = scanText(text.substr(0, kSampleBytes), path);
  LanguageGuess guess;
  if (scan.isMarkup || scan.isBinary)
    return guess;
  guess.hasCodes = hasCodes(scan);
  guess.namesControl = namesControl(scan);
  guess.isNamedForMilling = scan.count(TextSignal::MillName) != 0 && scan.count(TextSignal::LatheName) == 0;
  guess.hasJumps = scan.count(TextSignal::MacroControl) != 0 && scan.count(TextSignal::OWord) == 0;
  std::vector<int> scores = scoresOf(scan, registry);
  const int best = *std::max_element(scores.begin(), scores.end());
  const Best<ForeignLanguage> foreign = bestForeign(scan, registry);
  if (foreign.row != nullptr && foreign.score > best && hasForeignLines(scan)) {
    guess.foreign = foreign.row;
    guess.basis = GuessBasis::Text;
    guess.looksLikeProgram = true;
    guess.reasons = reasonsOf(scan, foreign.row->hints);
  } else if (scan.programLines > scan.otherLines) {
    guess.dialect = likeliestDialect(scores, registry);
    guess.looksLikeProgram = true;
    guess.hasOwnMarks = guess.namesControl || hasOwnMarks(scan, *guess.dialect);
    guess.reasons = reasonsOf(scan, guess.dialect->hints);
    guess.basis = prefers(scores, guess.dialect, registry) ? GuessBasis::Text : GuessBasis::Nothing;
    guess.scores = std::move(scores);
    guess.kin = foreign.row;
    guess.gCodeSystem = gCodeSystemOf(scan);
  }
  return guess;
}

} // namespace feedhold
