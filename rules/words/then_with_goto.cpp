// then-with-goto: `IF[..]THEN GOTO10`.
#include "findings/rule/rule.h"

namespace feedhold::rules {
namespace {

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.grammar.thenMayBeGoto)
    return;
  reporter.report({.message = "`THEN` before `GOTO`",
                   .span = issue.other,
                   .labels = {{issue.span, "the jump"}},
                   .notes = {"not every version of the control takes it; `IF[..]GOTO n` is right on all"},
                   .fixes = {{FixSafety::Safe, "remove `THEN`", {{issue.other, ""}}}}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::ThenWithGoto};

} // namespace

extern const Rule thenWithGoto;
const Rule thenWithGoto{.info = {"then-with-goto", Category::Syntax, Severity::Warning,
                                 "Reports `THEN GOTO`: some versions of the control take it, others stop."},
                        .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules
