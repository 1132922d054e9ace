// thread-too-high: `G76 X58. Z-20. P1300 Q250 F1.`: 1.3 mm is no height of a thread with a lead of 1 mm.
#include "rules/motion/turning_program.h"

#include <fmt/format.h>

#include <optional>

namespace feedhold::rules::thread_too_high {
namespace {

/// Of the lead, more than any thread is cut high: a metric thread is 0.613 times its pitch (ISO 68-1), a buttress
/// thread 0.868 times (DIN 513), and a sharp one of 55 degrees would be 0.96 times.  With several starts the lead is
/// larger yet.
constexpr double kHighest = 0.97;
constexpr double kMetricThread = 0.6134;

std::optional<double> literalOf(const Word &word) {
  return word.isNumber() && !word.has(Word::kArgument) ? std::optional(word.number().toDouble()) : std::nullopt;
}

/// In the units of the program.  P counts increments; in one block, K is the height as it is written.
struct Height {
  const Word *word;
  double value;
};
std::optional<Height> heightIn(BlockId block, const FileContext &context, bool isMetric) {
  const Word *inOneBlock = findWord(context.tree, block, 'K');
  const Word *word = inOneBlock ? inOneBlock : findWord(context.tree, block, 'P');
  const auto value = word ? literalOf(*word) : std::nullopt;
  if (!value || (!inOneBlock && word->has(Word::kPoint)))
    return std::nullopt;
  const LeastIncrements increments = leastIncrementsOf(context.dialect);
  const Decimal &increment = isMetric ? increments.metric : increments.inch;
  return Height{word, inOneBlock ? *value : *value * increment.toDouble()};
}

void checkCycle(BlockId block, bool isMetric, const FileContext &context, const Reporter &reporter) {
  const Word *cycle = findAction(context.tree, block, context.dialect, {CodeAction::ThreadPasses});
  const Word *leadWord = findWord(context.tree, block, 'F');
  const auto lead = leadWord ? literalOf(*leadWord) : std::nullopt;
  const auto height = cycle ? heightIn(block, context, isMetric) : std::nullopt;
  if (!height || !lead || *lead <= 0 || height->value <= kHighest * *lead)
    return;
  const std::string_view unit = isMetric ? "mm" : "inch";
  reporter.report(
      {.message = fmt::format("the thread of {} is {:g} {} high, and its lead is only {:g} {}",
                              context.quoted(cycle->span()), height->value, unit, *lead, unit),
       .span = height->word->span(),
       .labels = {{leadWord->span(), "the lead"}},
       .notes = {"no thread is as high as its lead: the crests are cut away, and the tool may break",
                 fmt::format("a metric thread with this lead is cut {:.3g} {} high: correct the height or the lead",
                             kMetricThread * *lead, unit)}});
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  forEachTurningCycle(program, context, [&](BlockId block, const TurningPoint &, const TurningWalk &walk) {
    checkCycle(block, walk.isMetric(), context, reporter);
  });
}

} // namespace

extern const Rule threadTooHigh;
const Rule threadTooHigh{.info = {"thread-too-high", Category::Motion, Severity::Warning,
                                  "Reports a threading cycle whose thread is higher than its lead."},
                         .hooks = {.program = check}};

} // namespace feedhold::rules::thread_too_high
