// while-without-condition: `WHILE DO1`.
#include "rules/structure/structure_view.h"

#include <fmt/format.h>

namespace feedhold::rules::while_without_condition {
namespace {

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (endWhileAt(context, issue.span))
    return; // `do-number` says so
  reporter.report({.message = "this WHILE has no condition",
                   .span = issue.span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WhileFormat)),
                             "write a loop without a condition as `DO1` .. `END1`"}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::WhileWithoutCondition};

} // namespace

extern const Rule whileWithoutCondition;
const Rule whileWithoutCondition{.info = {"while-without-condition", Category::Syntax, Severity::Error,
                                          "Reports a `WHILE` without a condition in brackets."},
                                 .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::while_without_condition
