// then-with-goto: `IF[..]THEN GOTO10`.
#include "findings/rule/rule.h"

namespace feedhold::rules::then_with_goto {
namespace {

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.grammar.thenMayBeGoto)
    return;
  reporter.report({.message = "`THEN` before `GOTO`",
                   .span = issue.other,
                   .labels = {{issue.span, "the jump"}},
                   .notes = {"some versions of the control stop here; `IF[..]GOTO n` works on all"},
                   .fixes = {{FixSafety::Safe, "remove `THEN`", {{issue.other, ""}}}}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::ThenWithGoto};

} // namespace

extern const Rule thenWithGoto;
const Rule thenWithGoto{.info = {"then-with-goto", Category::Syntax, Severity::Warning,
                                 "Reports `THEN GOTO`: some versions of the control accept it, others stop."},
                        .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::then_with_goto
