// relief-in-groove: `G75 X0.75 Z-1.625 P500 Q1250 R0.01`, where R is no retract.
#include "rules/motion/turning_program.h"

#include <fmt/format.h>

namespace feedhold::rules::relief_in_groove {
namespace {

/// `G75 X-1. Z0.15` from Z2: it faces or cuts off, and beside its cuts there is no wall.
bool cutsAcrossFace(const Word &cycle, const TurningPoint &start, const Word &across, const FileContext &context) {
  const bool isToCentre = across.isNumber() && (across.number().isZero() || across.number().isNegative());
  const bool startsInFront = start.z && *start.z > 0;
  return codeOf(cycle, context.dialect)->action == CodeAction::DiameterGroove && (isToCentre || startsInFront);
}

void checkCycle(BlockId block, const TurningPoint &start, const FileContext &context, const Reporter &reporter) {
  const Word *cycle =
      findAction(context.tree, block, context.dialect, {CodeAction::FaceGroove, CodeAction::DiameterGroove});
  const Word *relief = cycle ? findWord(context.tree, block, 'R') : nullptr;
  const Word *across = findWord(context.tree, block, 'X');
  const bool isGroove = across && findWord(context.tree, block, 'Z');
  if (!relief || !isGroove || !relief->isNumber() || relief->number().isZero() ||
      cutsAcrossFace(*cycle, start, *across, context))
    return;
  reporter.report(
      {.message = fmt::format("{} moves the tool sideways at the bottom of each cut", context.quoted(relief->span())),
       .span = relief->span(),
       .notes = {fmt::format("the first cut of a groove is as wide as the tool: it goes into the wall. The retract of "
                             "the pecks is R of another {} in front of this one",
                             context.quoted(cycle->span())),
                 fmt::format("write `{} {}` as a block of its own, and no R here", context.text(cycle->span()),
                             context.text(relief->span()))}});
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.behaviour.oneBlockCycles)
    return;
  forEachTurningCycle(program, context, [&](BlockId block, const TurningPoint &start, const TurningWalk &) {
    checkCycle(block, start, context, reporter);
  });
}

} // namespace

extern const Rule reliefInGroove;
const Rule reliefInGroove{.info = {"relief-in-groove", Category::Motion, Severity::Warning,
                                   "Reports a grooving cycle of a lathe with a sideways move at the bottom of its "
                                   "cuts."},
                          .hooks = {.program = check}};

} // namespace feedhold::rules::relief_in_groove
