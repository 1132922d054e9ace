// thread-height-differs: `G76 X26. Z-35. P1000 Q250 F4.5` on a diameter of 30: 2 mm are to be cut, and P says 1 mm.
#include "rules/motion/straight_cuts.h"
#include "rules/motion/turning_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace feedhold::rules::thread_height_differs {
namespace {

/// Of the larger one: less may be an allowance on the crests, or what the flanks of the tool leave.
constexpr double kClearly = 0.4;
/// Of the lead: more is no thread, so that one of the diameters is not that of this one.
constexpr double kHighest = 0.97;

std::optional<double> literalOf(const Word *word) {
  return word && word->isNumber() && !word->has(Word::kArgument) ? std::optional(word->number().toDouble())
                                                                 : std::nullopt;
}

struct Height {
  const Word *word;
  double value; // in the units of the program
};

/// P counts increments: where the text does not say of what, those that come nearest to the depth.
double countedHeight(double count, double depth, std::optional<bool> isMetric, const Dialect &dialect) {
  const LeastIncrements increments = leastIncrementsOf(dialect);
  const double metric = count * increments.metric.toDouble();
  const double inch = count * increments.inch.toDouble();
  if (isMetric)
    return *isMetric ? metric : inch;
  return std::abs(metric - depth) < std::abs(inch - depth) ? metric : inch;
}

/// In one block, K is the height as it is written, and P the way of cutting.
std::optional<Height> heightIn(BlockId block, double depth, std::optional<bool> isMetric, const FileContext &context) {
  const Word *inOneBlock = findWord(context.tree, block, 'K');
  const Word *word = inOneBlock                                 ? inOneBlock
                     : context.dialect.behaviour.oneBlockCycles ? nullptr
                                                                : findWord(context.tree, block, 'P');
  const auto value = literalOf(word);
  if (!value || (!inOneBlock && word->has(Word::kPoint)))
    return std::nullopt;
  return Height{word, inOneBlock ? *value : countedHeight(*value, depth, isMetric, context.dialect)};
}

double overlap(const StraightCut &cut, double from, double to) {
  const auto [low, high] = std::minmax(*cut.from.z, *cut.to.z);
  return std::min(high, std::max(from, to)) - std::max(low, std::min(from, to));
}

class Reader {
public:
  Reader(ProgramId program, const FileContext &context)
      : context_(context), walk_(program, context), cuts_(straightCutsOf(program, context)) {}

  void read(BlockId block, const Reporter &reporter) {
    const TurningPoint start = walk_.at();
    const TurningMove move = walk_.read(block);
    if (const Word *unit = findAction(context_.tree, block, context_.dialect, {CodeAction::Metric, CodeAction::Inch}))
      isMetric_ = codeOf(*unit, context_.dialect)->action == CodeAction::Metric;
    const Word *cycle = findAction(context_.tree, block, context_.dialect, {CodeAction::ThreadPasses});
    if (move == TurningMove::Cycle && cycle && start.x && start.z && !findWord(context_.tree, block, 'R'))
      judge(block, *cycle, start, reporter);
  }

private:
  void judge(BlockId block, const Word &cycle, const TurningPoint &start, const Reporter &reporter) const {
    const TurningPoint end = walk_.endOf(block);
    const auto lead = literalOf(findWord(context_.tree, block, 'F'));
    if (!lead || !end.x || !end.z || *start.x == *end.x)
      return;
    const auto turned = turnedBefore(block, start, end);
    if (turned == cuts_.end())
      return;
    const double across = *turned->second.to.x - *end.x;
    const double depth = (*start.x > *end.x ? across : -across) / 2;
    const double most = kHighest * *lead;
    const auto height = heightIn(block, depth, isMetric_, context_);
    if (!height || depth <= 0 || depth > most || height->value > most ||
        std::abs(depth - height->value) <= kClearly * std::max(depth, height->value))
      return;
    tell(cycle, *height, depth, *turned, end, reporter);
  }
  /// The last cut along Z over most of the thread.
  std::map<BlockId, StraightCut>::const_iterator turnedBefore(BlockId thread, const TurningPoint &start,
                                                              const TurningPoint &end) const {
    auto found = cuts_.end();
    for (auto at = cuts_.begin(); at != cuts_.end() && at->first < thread; ++at)
      if (*at->second.from.x == *at->second.to.x &&
          overlap(at->second, *start.z, *end.z) > std::abs(*start.z - *end.z) / 2)
        found = at;
    return found;
  }
  void tell(const Word &cycle, const Height &height, double depth, const std::pair<const BlockId, StraightCut> &turned,
            const TurningPoint &end, const Reporter &reporter) const {
    reporter.report(
        {.message = fmt::format("{} is a height of {:.4g}, and from X{:g} to X{:g} the thread is {:.4g} deep",
                                context_.quoted(height.word->span()), height.value, *turned.second.to.x, *end.x, depth),
         .span = height.word->span(),
         .labels = {{context_.tree.blocks[turned.first].span(), "the diameter before the thread"}},
         .notes = {
             height.value < depth
                 ? fmt::format("{} starts at the height that it is told: the first pass cuts all that is above it",
                               context_.quoted(cycle.span()))
                 : fmt::format("{} starts at the height that it is told: the first passes cut air",
                               context_.quoted(cycle.span())),
             "correct the height, or the X of the bottom of the thread"}});
  }

  const FileContext &context_;
  TurningWalk walk_;
  std::map<BlockId, StraightCut> cuts_;
  std::optional<bool> isMetric_; // where the program says it
};

} // namespace

extern const Rule threadHeightDiffers;
const Rule threadHeightDiffers{.info = {"thread-height-differs", Category::Motion, Severity::Warning,
                                        "Reports a threading cycle whose height is not the distance from the turned "
                                        "diameter to its X."},
                               .hooks = {.program = readTurningProgram<Reader>}};

} // namespace feedhold::rules::thread_height_differs
