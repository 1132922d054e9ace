// block-skip-level: `//`, `/0`.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::block_skip_level {
namespace {

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  Diagnostic diagnostic{.message = fmt::format("{} is not a valid block skip", context.quoted(issue.span)),
                        .span = issue.span,
                        .notes = {"the levels are `/1` to `/9`; two levels are written `/1/3`"}};
  if (context.text(issue.span).ends_with("//"))
    diagnostic.notes.push_back("put it in parentheses if it is a remark");
  reporter.report(std::move(diagnostic));
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::BlockSkipLevel};

} // namespace

extern const Rule blockSkipLevel;
const Rule blockSkipLevel{.info = {"block-skip-level", Category::Word, Severity::Error,
                                   "Reports a block skip with a level that does not exist: `//`, `/0`."},
                          .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::block_skip_level
