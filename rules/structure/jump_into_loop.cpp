// jump-into-loop: a GOTO from outside to a block between DO and END.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

namespace feedhold::rules {
namespace {

void check(const Jump &jump, const FileContext &context, const Reporter &reporter) {
  if (jump.kind != JumpKind::Goto || !jump.target)
    return;
  for (const Loop &loop : context.model.loopsIn(context.model.programs[jump.program].first, *jump.target)) {
    if (!isInside(loop, *jump.target))
      continue;
    if (jump.block == loop.doBlock || isInside(loop, jump.block))
      continue;
    const std::string number = loop.number ? std::to_string(*loop.number) : "";
    reporter.report({.message = fmt::format("{} jumps into the loop `DO{}`", context.quoted(jump.span), number),
                     .span = jump.span,
                     .labels = {{context.tree.statements[loop.doStatement].span, "the loop begins"},
                                {context.tree.blocks[*jump.target].span(), "the jump comes in here"}},
                     .notes = {fmt::format("at `END{}`, which no DO has opened, the control {}", number,
                                           stopsWith(context.dialect, AlarmKind::MissingDo)),
                               "jump to a block before the DO"}});
    return;
  }
}

} // namespace

extern const Rule jumpIntoLoop;
const Rule jumpIntoLoop{.info = {"jump-into-loop", Category::Structure, Severity::Warning,
                                 "Reports a jump from outside of a loop to a block inside of it."},
                        .hooks = {.jump = check}};

} // namespace feedhold::rules
