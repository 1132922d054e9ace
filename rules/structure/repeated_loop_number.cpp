// repeated-loop-number: `DO1` inside of `DO1`.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::repeated_loop_number {
namespace {

/// The nearest loop of the same number around a DO.
const Loop *enclosing(const LoopNest &nest, const Loop &inner) {
  const auto around = nest.around(inner.doBlock);
  const auto same = std::ranges::find_if(around, [&](const Loop *loop) { return loop->number == inner.number; });
  return same == around.end() ? nullptr : *same;
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.grammar.doNumberMayRepeatNested)
    return;
  const auto loops = context.model.loopsOf(program);
  const LoopNest nest(loops);
  for (const Loop &inner : loops) {
    const Loop *outer = inner.number ? enclosing(nest, inner) : nullptr;
    if (!outer)
      continue;
    reporter.report({.message = fmt::format("`DO{}` is inside another loop with the same number", *inner.number),
                     .span = context.tree.statements[inner.doStatement].span,
                     .labels = {{context.tree.statements[outer->doStatement].span, "this loop is still open"}},
                     .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::MissingEnd)),
                               fmt::format("give the inner loop another number, or add the missing `END{}` before it",
                                           *inner.number)}});
  }
}

} // namespace

extern const Rule repeatedLoopNumber;
const Rule repeatedLoopNumber{.info = {"repeated-loop-number", Category::Structure, Severity::Error,
                                       "Reports a loop inside another loop with the same number."},
                              .hooks = {.program = check}};

} // namespace feedhold::rules::repeated_loop_number
