// block-skip-level: `//`, `/0`.
#include "findings/rule/other_control.h"

#include <algorithm>
#include <fmt/format.h>
#include <string>

namespace feedhold::rules::block_skip_level {
namespace {

bool isDouble(const SyntaxIssue &issue, const FileContext &context) {
  return issue.kind == SyntaxIssueKind::BlockSkipLevel && context.text(issue.span).ends_with("//");
}

/// Once for all of the file: they have one cause.
void reportDouble(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  const auto isSame = [&](const SyntaxIssue &other) { return isDouble(other, context); };
  if (std::ranges::find_if(context.tree.issues, isSame)->span.begin != issue.span.begin)
    return;
  const auto others = std::ranges::count_if(context.tree.issues, isSame) - 1;
  const bool hasRemark = std::ranges::any_of(
      context.tree.issues, [&](const SyntaxIssue &other) { return isSame(other) && habitAt(other, context); });
  const std::string more =
      others == 0 ? "" : fmt::format(", here and in {} more block{}", others, others == 1 ? "" : "s");
  reporter.report({.message = hasRemark ? fmt::format("`//` does not begin a remark{}", more)
                                        : fmt::format("`//` is not a valid block skip{}", more),
                   .span = issue.span,
                   .notes = {"put remarks in parentheses, and blocks that were taken out, too",
                             "the levels of the block skip are `/1` to `/9`; two levels are written `/1/3`"}});
}

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (isDouble(issue, context))
    return reportDouble(issue, context, reporter);
  reporter.report({.message = fmt::format("{} is not a valid block skip", context.quoted(issue.span)),
                   .span = issue.span,
                   .notes = {"the levels are `/1` to `/9`; two levels are written `/1/3`"}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::BlockSkipLevel};

} // namespace

extern const Rule blockSkipLevel;
const Rule blockSkipLevel{.info = {"block-skip-level", Category::Word, Severity::Error,
                                   "Reports a block skip with a level that does not exist: `//`, `/0`."},
                          .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::block_skip_level
