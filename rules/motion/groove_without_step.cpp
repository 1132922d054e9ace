// groove-without-step: from Z-30. a `G75 X30. Z-33. P3000 Q0`, several grooves with no way between them.
#include "rules/motion/turning_program.h"

#include <fmt/format.h>

namespace feedhold::rules::groove_without_step {
namespace {

void checkCycle(BlockId block, const TurningPoint &start, const TurningWalk &walk, const FileContext &context,
                const Reporter &reporter) {
  const Word *cycle =
      findAction(context.tree, block, context.dialect, {CodeAction::FaceGroove, CodeAction::DiameterGroove});
  if (!cycle)
    return;
  const bool isFace = codeOf(*cycle, context.dialect)->action == CodeAction::FaceGroove;
  const char axis = isFace ? 'X' : 'Z';
  const Word *step = findWord(context.tree, block, isFace ? 'P' : 'Q');
  const TurningPoint end = walk.endOf(block);
  const auto &from = isFace ? start.x : start.z;
  const auto &to = isFace ? end.x : end.z;
  if (!step || !step->isNumber() || step->has(Word::kArgument) || !step->number().isZero() || !from || !to ||
      *from == *to)
    return;
  reporter.report(
      {.message = fmt::format("{} is no step, and {} goes on from {}{:g} to {}{:g}", context.quoted(step->span()),
                              context.quoted(cycle->span()), axis, *from, axis, *to),
       .span = step->span(),
       .notes = {"the control stops with an alarm, or cuts at the start only",
                 fmt::format("write the way from cut to cut, a little less than the width of the tool; for "
                             "one groove leave {} out",
                             axis)}});
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  forEachTurningCycle(program, context, [&](BlockId block, const TurningPoint &start, const TurningWalk &walk) {
    checkCycle(block, start, walk, context, reporter);
  });
}

} // namespace

extern const Rule grooveWithoutStep;
const Rule grooveWithoutStep{.info = {"groove-without-step", Category::Motion, Severity::Warning,
                                      "Reports a grooving cycle of a lathe with a step of zero to an end point that "
                                      "lies elsewhere."},
                             .hooks = {.program = check}};

} // namespace feedhold::rules::groove_without_step
