// stray-close-parenthesis: `(PLANAR))`.
#include "findings/rule/rule.h"

#include "base/support/text.h"
#include "language/dialect/line_signals.h"

#include <fmt/format.h>

namespace feedhold::rules::stray_close_parenthesis {
namespace {

/// The comment directly behind which the `)` stands: a slip of the finger, nothing else can be meant.
const Comment *commentBefore(const FileContext &context, Span parenthesis) {
  for (const Comment &comment : context.tree.commentsOf(context.tree.blockAt(parenthesis.begin)))
    if (comment.span.end <= parenthesis.begin && trimmed(context.text({comment.span.end, parenthesis.begin})).empty())
      return &comment;
  return nullptr;
}

/// A block that was taken out by hand, `(M98P100))`: the line holds nothing else.
bool isTakenOut(const FileContext &context, const Comment &comment) {
  const BlockId block = context.tree.blockAt(comment.span.begin);
  if (!context.tree.wordsOf(block).empty() || comment.span.size() < 3)
    return false;
  TextScan scan;
  scanLine(context.text({comment.span.begin + 1, comment.span.end - 1}), scan);
  return scan.programLines == 1 && (scan.codeLines == 1 || scan.count(TextSignal::MacroControl) != 0);
}

/// What controls make of it is told as nested-comment tells it, which is the same mistake.
void reportBehind(const Comment &comment, const SyntaxIssue &issue, const FileContext &context,
                  const Reporter &reporter) {
  const bool stops = context.dialect.grammar.oWords;
  const std::string stop = fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WordFormat));
  const Severity severity = isTakenOut(context, comment) ? Severity::Info : Severity::Warning;
  reporter.report({.message = "`)` is outside the comment",
                   .span = issue.span,
                   .labels = {{{comment.span.end - 1, comment.span.end}, "the comment ends here"}},
                   .notes = {stops ? stop : "some controls stop at a `)` outside a comment, others ignore it"},
                   .fixes = {{FixSafety::Safe, "remove `)`", {{issue.span, ""}}}}},
                  stops ? Severity::Error : severity);
}

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (const Comment *comment = commentBefore(context, issue.span))
    return reportBehind(*comment, issue, context, reporter);
  reporter.report({.message = "this `)` has no matching `(`",
                   .span = issue.span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WordFormat))},
                   .fixes = {{FixSafety::NeedsReview, "remove `)`", {{issue.span, ""}}}}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::StrayCloseParenthesis};

} // namespace

extern const Rule strayCloseParenthesis;
const Rule strayCloseParenthesis{
    .info = {"stray-close-parenthesis", Category::Comment, Severity::Error, "Reports a `)` without a `(`."},
    .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::stray_close_parenthesis
