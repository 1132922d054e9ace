// unexpected-text: bytes that the control does not know.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

namespace feedhold::rules::unexpected_text {
namespace {

/// `X?` is how templates mark a number to be filled in.
bool isPlaceholder(std::string_view text) { return trimmed(text).find_first_not_of('?') == std::string_view::npos; }

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (isPlaceholder(context.text(issue.span)))
    return;
  reporter.report({.message = fmt::format("{} is not part of a word or statement", context.quoted(issue.span)),
                   .span = issue.span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WordFormat)),
                             "delete it, or put it in parentheses if it is a remark"}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::UnexpectedText};

} // namespace

extern const Rule unexpectedText;
const Rule unexpectedText{.info = {"unexpected-text", Category::Syntax, Severity::Error,
                                   "Reports text that is not part of a word, a statement or a comment."},
                          .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::unexpected_text
