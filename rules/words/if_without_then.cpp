// if-without-then: `IF[#1EQ0]#2=1`.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules {
namespace {

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.grammar.thenMayBeOmitted)
    return;
  reporter.report({.message = fmt::format("no `THEN` before {}", context.quoted(issue.span)),
                   .span = issue.span,
                   .labels = {{issue.other, "the IF"}},
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::IfFormat))}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::IfWithoutThen};

} // namespace

extern const Rule ifWithoutThen;
const Rule ifWithoutThen{.info = {"if-without-then", Category::Syntax, Severity::Error,
                                  "Reports an `IF` whose action follows the condition without `THEN` or `GOTO`."},
                         .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules
