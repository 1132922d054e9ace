// while-without-do: `WHILE[#1LT5]` without DO.
#include "rules/structure/structure_view.h"

#include <fmt/format.h>

namespace feedhold::rules::while_without_do {
namespace {

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (endWhileAt(context, issue.span))
    return; // `do-number` says so
  reporter.report({.message = "this WHILE has no DO",
                   .span = issue.span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WhileFormat))}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::WhileWithoutDo};

} // namespace

extern const Rule whileWithoutDo;
const Rule whileWithoutDo{.info = {"while-without-do", Category::Syntax, Severity::Error,
                                   "Reports a `WHILE` without a `DO` after its condition."},
                          .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::while_without_do
