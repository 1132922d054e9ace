// misplaced-block-skip: `Z-1.0/M08`.
#include "findings/rule/rule.h"

namespace feedhold::rules {
namespace {

void check(const SyntaxIssue &issue, const FileContext &, const Reporter &reporter) {
  reporter.report(
      {.message = "block skip in mid-block",
       .span = issue.span,
       .notes = {"with the switch on, only what stands before it is run; on some machines the whole block counts"}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::MisplacedBlockSkip};

} // namespace

extern const Rule misplacedBlockSkip;
const Rule misplacedBlockSkip{.info = {"misplaced-block-skip", Category::Word, Severity::Info,
                                       "Reports a `/` in mid-block: with the switch on, the control skips what stands "
                                       "behind it and runs what stands before."},
                              .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules
