// if-without-action: `IF[#1EQ0]` and the end of the block.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::if_without_action {
namespace {

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  // Where THEN may be left out, no manual says what becomes of a condition alone.
  if (context.dialect.grammar.thenMayBeOmitted) {
    reporter.report({.message = "this IF has no action",
                     .span = issue.span,
                     .notes = {"the manual has no such form: the control stops, or the condition has no effect",
                               "write the action in this block: `IF[..]GOTO10` or `IF[..]THEN#1=0`"}},
                    Severity::Warning);
    return;
  }
  reporter.report({.message = "this IF has no action",
                   .span = issue.span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::IfFormat)),
                             "write the action in this block: `IF[..]GOTO10` or `IF[..]THEN#1=0`"}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::IfWithoutAction};

} // namespace

extern const Rule ifWithoutAction;
const Rule ifWithoutAction{.info = {"if-without-action", Category::Syntax, Severity::Error,
                                    "Reports an `IF` with a condition but without an action."},
                           .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::if_without_action
