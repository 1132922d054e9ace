// unclosed-comment: `(` without `)`.
#include "findings/rule/rule.h"

namespace feedhold::rules::unclosed_comment {
namespace {

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (context.text(issue.span).ends_with(')')) {
    reporter.report(
        {.message = "this comment goes over several lines",
         .span = {issue.span.begin, issue.span.begin + 1},
         .labels = {{{issue.span.end - 1, issue.span.end}, "closed here"}},
         .notes = {"the control reads each line as a block, and a comment ends with its block on most controls",
                   "put each line of the comment in parentheses of its own"}});
    return;
  }
  reporter.report({.message = "this comment has no closing `)`",
                   .span = issue.span,
                   .notes = {"the control does not execute what follows the `(`"},
                   .fixes = {{.title = "insert `)`", .edits = {{{issue.span.end, issue.span.end}, ")"}}}}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::UnclosedComment};

} // namespace

extern const Rule unclosedComment;
const Rule unclosedComment{
    .info =
        {"unclosed-comment", Category::Comment, Severity::Error,
         "Reports a comment without its `)`: the rest of the line, and on some controls the next lines, are ignored."},
    .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::unclosed_comment
