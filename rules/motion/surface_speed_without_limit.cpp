// surface-speed-without-limit: `G96 S255 M03`, and no `G50 S` in the program.
#include "language/dialect/code_name.h"
#include "rules/motion/motion_view.h"
#include "rules/motion/turning_walk.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::surface_speed_without_limit {
namespace {

bool isAcross(const Word &word) { return word.address() == 'X' && !word.has(Word::kArgument); }

/// Follows G96 and the moves in X through the text of one program.
class Reader {
public:
  Reader(ProgramId program, const FileContext &context) : context_(context), walk_(program, context) {}

  void read(BlockId block) {
    mayBeLimited_ = mayBeLimited_ || mayLimit(block);
    if (const Word *code = findAction(context_.tree, block, context_.dialect, {CodeAction::ConstantSurface})) {
      surface_ = code;
      first_ = first_ ? first_ : code;
    }
    if (findAction(context_.tree, block, context_.dialect, {CodeAction::ConstantSpeed}))
      surface_ = nullptr;
    followCuts(block);
    // A code of its own, such as G28 or G50, gives X another meaning.
    if (!surface_ || centre_ || meansOther(block))
      return;
    for (const Word &word : context_.tree.wordsOf(block))
      if (isAcross(word) && word.isNumber() && (word.number().isZero() || word.number().isNegative()))
        centre_ = Centre{surface_, &word};
  }

  void report(const Reporter &reporter) const {
    if (mayBeLimited_ || !first_)
      return;
    const Word &code = centre_ ? *centre_->surface : *first_;
    const bool comesNear = least_ && *least_ < most_ / 2;
    Diagnostic diagnostic{
        .message = fmt::format("{} without a limit of the spindle speed", context_.quoted(code.span())),
        .span = code.span(),
        .notes = {centre_ ? "at the centre the spindle runs at the highest speed of the machine, or at the limit that "
                            "another program has left: the chuck may lose the part"
                  : comesNear
                      ? fmt::format("the spindle gets faster the smaller the diameter is, here down to X{:g}, and no "
                                    "limit holds it back",
                                    *least_)
                      : "the spindle gets faster the smaller the diameter is, up to the highest speed of the "
                        "machine or the limit that another program has left",
                  fmt::format("write `{} S` with the highest speed for this chuck and part before it", limitCode())}};
    if (centre_)
      diagnostic.labels = {{centre_->word->span(), "to the centre"}};
    reporter.report(std::move(diagnostic), centre_ || comesNear ? Severity::Warning : Severity::Info);
  }

private:
  /// How far towards the centre the program cuts with constant surface speed, and how far out it cuts at all.
  void followCuts(BlockId block) {
    const TurningPoint before = walk_.at();
    const TurningMove move = walk_.read(block);
    if (move != TurningMove::Feed && move != TurningMove::Cycle)
      return;
    noteCut(before.x);
    noteCut(walk_.at().x);
    for (const Contour &contour : walk_.contours())
      if (contour.cycle->block == block)
        for (const TurningPoint &corner : walk_.cornersOf(contour, before))
          noteCut(corner.x);
  }
  void noteCut(const std::optional<double> &x) {
    if (!x || *x < 0)
      return;
    most_ = std::max(most_, *x);
    if (surface_)
      least_ = std::min(least_.value_or(*x), *x);
  }

  struct Centre {
    const Word *surface; // the G96 in force
    const Word *word;    // the X
  };

  /// `G50 S1500`, `G92 S1500`, `G96 S150 D1500`, or what is not seen here: a call.  Which of the two it is depends on
  /// the G code system, which the text may not show.
  bool mayLimit(BlockId block) const {
    const bool sets = std::ranges::any_of(context_.tree.wordsOf(block), [](const Word &word) {
      return word.address() == 'G' && (word.integer() == 50U || word.integer() == 92U);
    });
    const bool setsBeside = findAction(context_.tree, block, context_.dialect, {CodeAction::ConstantSurface}) &&
                            findWord(context_.tree, block, 'D');
    return setsBeside || !context_.model.callsIn(block, block.next()).empty() ||
           (sets && findWord(context_.tree, block, 'S'));
  }
  /// Of the G code system in force.
  std::string limitCode() const {
    const auto sets = std::ranges::find(context_.dialect.gCodes, CodeAction::CoordinateSet, &Code::action);
    return sets == context_.dialect.gCodes.end() ? "G50" : codeName('G', sets->tenths);
  }
  bool meansOther(BlockId block) const {
    return findAction(context_.tree, block, context_.dialect,
                      {CodeAction::CoordinateSet, CodeAction::ReferenceReturn, CodeAction::SecondReference,
                       CodeAction::MachineMove, CodeAction::Dwell, CodeAction::Thread}) ||
           findTurningCycle(context_.tree, block, context_.dialect) ||
           meansOwnWords(context_.tree, block, context_.dialect);
  }

  const FileContext &context_;
  const Word *surface_ = nullptr; // in force
  const Word *first_ = nullptr;
  std::optional<Centre> centre_; // the first move to it
  TurningWalk walk_;
  std::optional<double> least_;
  double most_ = 0;
  bool mayBeLimited_ = false;
};

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Turning || startedBy(context, program) != StartedBy::Operator)
    return;
  Reader reader(program, context);
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next())
    reader.read(block);
  reader.report(reporter);
}

} // namespace

extern const Rule surfaceSpeedWithoutLimit;
const Rule surfaceSpeedWithoutLimit{
    .info = {"surface-speed-without-limit", Category::Motion, Severity::Warning,
             "Reports constant surface speed in a main program of a lathe that limits the spindle speed nowhere."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::surface_speed_without_limit
