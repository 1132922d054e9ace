// goto-without-target: `GOTO` alone.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules {
namespace {

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = "this GOTO names no sequence number",
                   .span = issue.span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::SequenceNotFound))}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::GotoWithoutTarget};

} // namespace

extern const Rule gotoWithoutTarget;
const Rule gotoWithoutTarget{.info = {"goto-without-target", Category::Syntax, Severity::Error,
                                      "Reports a `GOTO` that does not say where to go."},
                             .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules
