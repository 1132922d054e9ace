// block-too-long: thousands of words without an end of block.
#include "findings/rule/rule.h"

namespace feedhold::rules::block_too_long {
namespace {

void check(const SyntaxIssue &issue, const FileContext &, const Reporter &reporter) {
  reporter.report({.message = "this block has more words than any control reads",
                   .span = issue.span,
                   .label = "reading stopped here",
                   .notes = {"the line ends of the file are probably lost; the rest of this block is not checked"}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::BlockTooLong};

} // namespace

extern const Rule blockTooLong;
const Rule blockTooLong{.info = {"block-too-long", Category::Syntax, Severity::Error,
                                 "Reports a block of thousands of words, as in a file that has lost its line ends."},
                        .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::block_too_long
