// unbalanced-brackets: brackets that do not pair.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::unbalanced_brackets {
namespace {

void missingOpen(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  reporter.report(
      {.message = fmt::format("`[` is missing after {}", context.quoted(issue.other)),
       .span = issue.other,
       .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::MissingOpenBracket))}});
}

void missingClose(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = "this `[` has no matching `]`",
                   .span = issue.other,
                   .labels = {{issue.span, "no `]` up to here"}},
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::MissingCloseBracket))},
                   .fixes = {{.title = "insert `]`", .edits = {{{issue.span.begin, issue.span.begin}, "]"}}}}});
}

void strayClose(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = "this `]` has no matching `[`",
                   .span = issue.span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::MissingOpenBracket))},
                   .fixes = {{.title = "remove `]`", .edits = {{issue.span, ""}}}}});
}

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (issue.kind == SyntaxIssueKind::MissingOpenBracket)
    missingOpen(issue, context, reporter);
  else if (issue.kind == SyntaxIssueKind::MissingCloseBracket)
    missingClose(issue, context, reporter);
  else
    strayClose(issue, context, reporter);
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::MissingOpenBracket, SyntaxIssueKind::MissingCloseBracket,
                                       SyntaxIssueKind::StrayCloseBracket};

} // namespace

extern const Rule unbalancedBrackets;
const Rule unbalancedBrackets{
    .info = {"unbalanced-brackets", Category::Expression, Severity::Error,
             "Reports a `[` without a `]`, a `]` without a `[`, and a function without brackets."},
    .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::unbalanced_brackets
