// nested-comment: `(A (B) C)`: `C)` is read as program.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

namespace feedhold::rules::nested_comment {
namespace {

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  const std::uint32_t end = issue.other.begin + static_cast<std::uint32_t>(context.text(issue.other).find(')')) + 1;
  const Span rest{end, issue.other.end};
  const bool nothingLost = trimmed(context.text({rest.begin, rest.end - 1})).empty();
  reporter.report(
      {.message = fmt::format("{} is outside the comment", context.quoted(rest)),
       .span = rest,
       .labels = {{issue.span, "this `(` does not open a comment"}, {{end - 1, end}, "the comment ends here"}},
       .notes = {"comments do not nest: the control reads the text after the first `)` as program"},
       .fixes = {{nothingLost ? FixSafety::Safe : FixSafety::NeedsReview,
                  "remove the inner parentheses",
                  {{issue.span, ""}, {{end - 1, end}, ""}}}}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::NestedComment};

} // namespace

extern const Rule nestedComment;
const Rule nestedComment{
    .info =
        {"nested-comment", Category::Comment, Severity::Error,
         "Reports parentheses inside a comment: the comment ends at the first `)`, and the rest is read as program."},
    .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::nested_comment
