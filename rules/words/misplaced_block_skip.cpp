// misplaced-block-skip: `Z-1.0/M08`.
#include "findings/rule/rule.h"

namespace feedhold::rules::misplaced_block_skip {
namespace {

void check(const SyntaxIssue &issue, const FileContext &, const Reporter &reporter) {
  reporter.report(
      {.message = "block skip within a block",
       .span = issue.span,
       .notes = {"with the switch on, the words before it are still executed; some machines skip the whole block",
                 "put the `/` at the head of the block, or split the block"}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::MisplacedBlockSkip};

} // namespace

extern const Rule misplacedBlockSkip;
const Rule misplacedBlockSkip{
    .info = {"misplaced-block-skip", Category::Word, Severity::Info,
             "Reports a `/` within a block: with the switch on, only the words before it are executed."},
    .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::misplaced_block_skip
