// stray-close-parenthesis: `(PLANAR))`.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

namespace feedhold::rules::stray_close_parenthesis {
namespace {

/// The `)` stands directly behind a comment: a slip of the finger, nothing else can be meant.
bool followsComment(const FileContext &context, Span parenthesis) {
  for (const Comment &comment : context.tree.commentsOf(context.tree.blockAt(parenthesis.begin)))
    if (comment.span.end <= parenthesis.begin && trimmed(context.text({comment.span.end, parenthesis.begin})).empty())
      return true;
  return false;
}

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  const bool direct = followsComment(context, issue.span);
  reporter.report({.message = "this `)` has no matching `(`",
                   .span = issue.span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WordFormat))},
                   .fixes = {{direct ? FixSafety::Safe : FixSafety::NeedsReview, "remove `)`", {{issue.span, ""}}}}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::StrayCloseParenthesis};

} // namespace

extern const Rule strayCloseParenthesis;
const Rule strayCloseParenthesis{
    .info = {"stray-close-parenthesis", Category::Comment, Severity::Error, "Reports a `)` without a `(`."},
    .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::stray_close_parenthesis
