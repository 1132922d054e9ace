// goto-without-target: `GOTO` alone.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules {
namespace {

/// `GOTO N10`: the number is there, and an N too many.
std::vector<FixIt> fixesFor(Span jump, const FileContext &context) {
  for (const Word &word : context.tree.wordsOf(context.tree.blockAt(jump.begin)))
    if (word.address() == 'N' && word.isNumber() && word.span().begin >= jump.end)
      return {{FixSafety::Safe, "take out the `N`", {{{word.span().begin, word.span().begin + 1}, ""}}}};
  return {};
}

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = "this GOTO names no sequence number",
                   .span = issue.span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::SequenceNotFound))},
                   .fixes = fixesFor(issue.span, context)});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::GotoWithoutTarget};

} // namespace

extern const Rule gotoWithoutTarget;
const Rule gotoWithoutTarget{.info = {"goto-without-target", Category::Syntax, Severity::Error,
                                      "Reports a `GOTO` that does not say where to go."},
                             .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules
