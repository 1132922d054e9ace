// jump-into-loop: a GOTO from outside to a block between DO and END.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

namespace feedhold::rules::jump_into_loop {
namespace {

void report(const Jump &jump, const Loop &loop, const FileContext &context, const Reporter &reporter) {
  const std::string number = loop.number ? std::to_string(*loop.number) : "";
  reporter.report({.message = fmt::format("{} jumps into the loop `DO{}`", context.quoted(jump.span), number),
                   .span = jump.span,
                   .labels = {{context.tree.statements[loop.doStatement].span, "the loop begins here"},
                              {context.tree.blocks[*jump.target].span(), "the jump arrives here"}},
                   .notes = {fmt::format("the jump skips the DO: at `END{}` the control {}", number,
                                         stopsWith(context.dialect, AlarmKind::MissingDo)),
                             "jump to the DO, or to a block before it"}});
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  const LoopNest nest(context.model.loopsOf(program));
  for (const Jump &jump : context.model.jumpsOf(program)) {
    if (jump.kind != JumpKind::Goto || !jump.target)
      continue;
    std::vector<const Loop *> entered = nest.around(*jump.target);
    std::erase_if(entered,
                  [&](const Loop *loop) { return jump.block == loop->doBlock || isInside(*loop, jump.block); });
    if (!entered.empty()) // the outermost: what is inside of it is entered too
      report(jump, *entered.back(), context, reporter);
  }
}

} // namespace

extern const Rule jumpIntoLoop;
const Rule jumpIntoLoop{.info = {"jump-into-loop", Category::Structure, Severity::Warning,
                                 "Reports a jump from outside a loop to a block inside it."},
                        .hooks = {.program = check}};

} // namespace feedhold::rules::jump_into_loop
