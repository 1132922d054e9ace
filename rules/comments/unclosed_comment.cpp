// unclosed-comment: `(` without `)`.
#include "findings/rule/rule.h"

namespace feedhold::rules::unclosed_comment {
namespace {

void check(const SyntaxIssue &issue, const FileContext &, const Reporter &reporter) {
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
