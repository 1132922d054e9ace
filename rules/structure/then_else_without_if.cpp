// then-else-without-if: THEN, ELSE or ENDIF that belongs to no IF.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

namespace feedhold::rules::then_else_without_if {
namespace {

Diagnostic withoutIf(Span span, const FileContext &context) {
  return {.message = fmt::format("{} has no `IF`", context.quoted(span)),
          .span = span,
          .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::IfFormat))}};
}

void checkThen(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  reporter.report(withoutIf(issue.span, context));
}

void checkLines(ProgramId program, const FileContext &context, const Reporter &reporter) {
  for (const StatementId stray : ifStructures(context, program).strays)
    reporter.report(withoutIf(context.tree.statements[stray].span, context));
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::ThenWithoutIf};

} // namespace

extern const Rule thenElseWithoutIf;
const Rule thenElseWithoutIf{.info = {"then-else-without-if", Category::Structure, Severity::Error,
                                      "Reports a `THEN`, `ELSE` or `ENDIF` without an `IF`."},
                             .hooks = {.issue = checkThen, .issueKinds = kIssues, .program = checkLines}};

} // namespace feedhold::rules::then_else_without_if
