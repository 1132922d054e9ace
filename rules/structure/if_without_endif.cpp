// if-without-endif: an IF over several lines that is never closed.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

namespace feedhold::rules::if_without_endif {
namespace {

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.grammar.blockIf)
    return;
  for (const IfLines &lines : ifStructures(context, program).structures) {
    if (lines.closed)
      continue;
    Diagnostic diagnostic{.message = "this `IF` has no `ENDIF`",
                          .span = context.tree.statements[lines.head].span,
                          .notes = {fmt::format("{} takes `THEN` at the end of a block for the start of an `IF` over "
                                                "several lines; if the program is for another control, name it with "
                                                "`--dialect`",
                                                context.dialect.id),
                                    fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::IfFormat))}};
    if (!lines.parts.empty())
      diagnostic.labels.push_back({context.tree.statements[lines.parts.back()].span, "its last branch begins here"});
    reporter.report(std::move(diagnostic));
  }
}

} // namespace

extern const Rule ifWithoutEndif;
const Rule ifWithoutEndif{.info = {"if-without-endif", Category::Structure, Severity::Error,
                                   "Reports an `IF` over several lines that no `ENDIF` closes."},
                          .hooks = {.program = check}};

} // namespace feedhold::rules::if_without_endif
