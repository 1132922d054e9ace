// repeated-loop-number: `DO1` inside of `DO1`.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

namespace feedhold::rules {
namespace {

/// The nearest loop of the same number around a DO.
const Loop *enclosing(const std::vector<Loop> &loops, std::size_t inner) {
  for (std::size_t i = inner; i-- > 0;)
    if (loops[i].program == loops[inner].program && loops[i].number == loops[inner].number &&
        isInside(loops[i], loops[inner].doBlock))
      return &loops[i];
  return nullptr;
}

void check(const FileContext &context, const Reporter &reporter) {
  if (context.dialect.grammar.doNumberMayRepeatNested)
    return;
  const std::vector<Loop> &loops = context.model.loops;
  for (std::size_t i = 1; i < loops.size(); ++i) {
    const Loop *outer = loops[i].number ? enclosing(loops, i) : nullptr;
    if (!outer)
      continue;
    reporter.report({.message = fmt::format("`DO{}` inside of a loop with the same number", *loops[i].number),
                     .span = context.tree.statements[loops[i].doStatement].span,
                     .labels = {{context.tree.statements[outer->doStatement].span, "this loop is still open"}},
                     .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::MissingEnd)),
                               fmt::format("number the inner loop differently, or put the missing `END{}` before it",
                                           *loops[i].number)}});
  }
}

} // namespace

extern const Rule repeatedLoopNumber;
const Rule repeatedLoopNumber{.info = {"repeated-loop-number", Category::Structure, Severity::Error,
                                       "Reports a loop inside of another loop with the same number."},
                              .hooks = {.file = check}};

} // namespace feedhold::rules
