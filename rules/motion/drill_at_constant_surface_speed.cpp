// drill-at-constant-surface-speed: `G96 S80 M03`, `G00 X0 Z2.`, `G01 Z-5. F0.15`.
#include "rules/motion/turning_program.h"

#include <fmt/format.h>

#include <optional>

namespace feedhold::rules::drill_at_constant_surface_speed {
namespace {

/// How deep a feed goes at least that is no facing cut: in the units of the program, and in inches.  A text that does
/// not name its units may be in either.
constexpr double kLeastDepth = 2;
constexpr double kLeastDepthInInches = 0.08;
constexpr double kLeastDepthInEither = 1;

class Reader {
public:
  Reader(ProgramId program, const FileContext &context)
      : context_(context), hidden_(program, context), walk_(program, context) {}

  void read(BlockId block, const Reporter &reporter) {
    if (findWord(context_.tree, block, 'T')) {
      isTold_ = false;
      limit_.reset();
    }
    if (hidden_.isIn(block))
      constant_ = nullptr;
    if (const auto limit = speedLimitIn(block, context_))
      limit_ = limit;
    for (const Word &word : context_.tree.wordsOf(block))
      follow(word);
    const TurningPoint start = walk_.at();
    const TurningMove move = walk_.read(block);
    const bool canTell = constant_ && !isStopped_ && !isTold_;
    if (const Word *drilled = canTell ? drilledBy(block, start, move) : nullptr)
      tell(*drilled, reporter);
  }

private:
  void follow(const Word &word) {
    const Code *code = codeOf(word, context_.dialect);
    const CodeAction action = code ? code->action : CodeAction::Unclassified;
    if (action == CodeAction::ConstantSurface)
      constant_ = &word;
    else if (action == CodeAction::ConstantSpeed)
      constant_ = nullptr;
    else if (action == CodeAction::SpindleStop)
      isStopped_ = true;
    else if (action == CodeAction::SpindleClockwise || action == CodeAction::SpindleCounterclockwise)
      isStopped_ = false;
    isMetric_ = isMetric_ || action == CodeAction::Metric;
    isInch_ = isInch_ || action == CodeAction::Inch;
  }

  /// The word of the block that takes the tool into the part along its axis.
  const Word *drilledBy(BlockId block, const TurningPoint &start, TurningMove move) const {
    const Word *across = findWord(context_.tree, block, 'X');
    const Word *depth = findWord(context_.tree, block, 'Z');
    const bool isOnAxis = across ? across->isNumber() && across->number().isZero() : start.x == 0.0;
    if (!isOnAxis || !depth || !depth->isNumber() || findWord(context_.tree, block, 'U'))
      return nullptr;
    for (const Word &word : context_.tree.wordsOf(block))
      if (drillsAlongZ(word, context_))
        return depth->number().isNegative() ? &word : nullptr;
    const bool isCut = move == TurningMove::Feed && start.x == 0.0 && goesDeep(*depth, start) && !isArcOrThread(block);
    return isCut ? depth : nullptr;
  }
  bool goesDeep(const Word &depth, const TurningPoint &start) const {
    const double end = depth.number().toDouble();
    const double least = isMetric_ == isInch_ ? kLeastDepthInEither : isMetric_ ? kLeastDepth : kLeastDepthInInches;
    return end <= -least && (!start.z || *start.z - end >= least);
  }
  bool isArcOrThread(BlockId block) const {
    return findCode(context_.tree, block, context_.dialect, CodeRole::Arc) ||
           findAction(context_.tree, block, context_.dialect, {CodeAction::Thread});
  }

  void tell(const Word &drilled, const Reporter &reporter) {
    isTold_ = true;
    Diagnostic diagnostic{
        .message = fmt::format("{} drills at the centre with constant surface speed", context_.quoted(drilled.span())),
        .span = drilled.span(),
        .labels = {{constant_->span(), "constant surface speed from here"}},
        .notes = {limit_ ? "at X0 the spindle turns at the limit, whatever the S of the drill is"
                         : "at X0 the spindle turns at its highest speed, or at the limit that was set before",
                  "program `G97` and the speed of the drill in revolutions per minute before it"}};
    if (limit_)
      diagnostic.labels.push_back({limit_->span(), "the limit for this tool"});
    reporter.report(std::move(diagnostic), limit_ ? Severity::Info : Severity::Warning);
  }

  const FileContext &context_;
  HiddenWork hidden_;
  TurningWalk walk_;
  const Word *constant_ = nullptr;  // the G96 in force
  std::optional<SpeedLimit> limit_; // of the tool in use
  bool isStopped_ = false;          // M05
  bool isMetric_ = false;
  bool isInch_ = false;
  bool isTold_ = false; // of the tool in use
};

} // namespace

extern const Rule drillAtConstantSurfaceSpeed;
const Rule drillAtConstantSurfaceSpeed{.info = {"drill-at-constant-surface-speed", Category::Motion, Severity::Warning,
                                                "Reports a lathe that drills, taps or bores along the axis of the "
                                                "spindle while `G96` is active."},
                                       .hooks = {.program = readTurningProgram<Reader>}};

} // namespace feedhold::rules::drill_at_constant_surface_speed
