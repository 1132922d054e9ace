// then-without-if: `THEN` in a place of its own.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules {
namespace {

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = "no `IF` before this THEN",
                   .span = issue.span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::IfFormat)),
                             "the condition and its action stand in one block"}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::ThenWithoutIf};

} // namespace

extern const Rule thenWithoutIf;
const Rule thenWithoutIf{
    .info = {"then-without-if", Category::Syntax, Severity::Error, "Reports a `THEN` that no condition stands before."},
    .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules
