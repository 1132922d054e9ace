// if-without-condition: `IF GOTO10`.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::if_without_condition {
namespace {

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = "this IF has no condition",
                   .span = issue.span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::IfFormat))}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::IfWithoutCondition};

} // namespace

extern const Rule ifWithoutCondition;
const Rule ifWithoutCondition{.info = {"if-without-condition", Category::Syntax, Severity::Error,
                                       "Reports an `IF` without a condition in brackets."},
                              .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::if_without_condition
