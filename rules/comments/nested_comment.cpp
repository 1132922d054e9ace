// nested-comment: `(A (B) C)`: `C)` is read as program.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

namespace feedhold::rules {
namespace {

/// What stands between the end of the comment and the next `)` of the block; absent when there is none.
std::optional<Span> leftOver(const FileContext &context, Span comment) {
  const Block &block = context.tree.blocks[context.tree.blockAt(comment.begin)];
  const std::size_t close = context.text({comment.end, block.end}).find_first_of("()");
  if (close == std::string_view::npos)
    return std::nullopt;
  const auto end = comment.end + static_cast<std::uint32_t>(close);
  const bool closes = context.source.text()[end] == ')' && !trimmed(context.text({comment.end, end})).empty();
  return closes ? std::optional(Span{comment.end, end}) : std::nullopt;
}

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  const auto rest = leftOver(context, issue.other);
  if (!rest)
    return;
  reporter.report({.message = fmt::format("{} stands outside of the comment", context.quoted(*rest)),
                   .span = *rest,
                   .labels = {{issue.span, "this `(` opens nothing"},
                              {{issue.other.end - 1, issue.other.end}, "the comment ends here"}},
                   .notes = {"comments do not nest: the control reads what follows the first `)` as program"}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::NestedComment};

} // namespace

extern const Rule nestedComment;
const Rule nestedComment{
    .info = {"nested-comment", Category::Comment, Severity::Error,
             "Reports a parenthesis inside a comment when program text is left behind the first `)`."},
    .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules
