// else-needs-block-if: IF .. ELSE .. ENDIF over several lines on a control that has only the short IF.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

namespace feedhold::rules::else_needs_block_if {
namespace {

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.grammar.blockIf)
    return;
  for (const IfLines &lines : ifStructures(context, program).structures) {
    if (lines.parts.empty())
      continue;
    const Span span = context.tree.statements[lines.parts.front()].span;
    reporter.report({.message = fmt::format("{} does not have {}", context.dialect.id, context.quoted(span)),
                     .span = span,
                     .labels = {{context.tree.statements[lines.head].span, "the IF it belongs to"}},
                     .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WordFormat)),
                               "jump over the other branch with `IF[..]GOTO`"}});
  }
}

} // namespace

extern const Rule elseNeedsBlockIf;
const Rule elseNeedsBlockIf{
    .info = {"else-needs-block-if", Category::Structure, Severity::Error,
             "Reports `ELSE`, `ELSEIF` or `ENDIF` on a control that only has the one-line `IF`."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::else_needs_block_if
