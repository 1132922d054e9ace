// misplaced-block-skip: `Z-1.0/M08`.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <algorithm>

namespace feedhold::rules::misplaced_block_skip {
namespace {

/// `M00 /clamp again`: unexpected-text speaks of what follows.
bool isBeforeProse(const SyntaxIssue &issue, const FileContext &context) {
  const auto next = std::ranges::lower_bound(context.tree.issues, issue.span.end, {},
                                             [](const SyntaxIssue &other) { return other.span.begin; });
  return next != context.tree.issues.end() && next->kind == SyntaxIssueKind::UnexpectedText &&
         trimmed(context.text({issue.span.end, next->span.begin})).empty();
}

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (isBeforeProse(issue, context))
    return;
  const bool stops = context.dialect.behaviour.stopsAtStrayWords;
  reporter.report(
      {.message = "block skip within a block",
       .span = issue.span,
       .notes = {stops
                     ? "the control stops with an error: bad character"
                     : "with the switch on, the words before it are still executed; some machines skip the whole block",
                 "put the `/` at the head of the block, or split the block"}},
      stops ? Severity::Error : Severity::Info);
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::MisplacedBlockSkip};

} // namespace

extern const Rule misplacedBlockSkip;
const Rule misplacedBlockSkip{
    .info = {"misplaced-block-skip", Category::Word, Severity::Info,
             "Reports a `/` within a block: with the switch on, only the words before it are executed."},
    .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::misplaced_block_skip
