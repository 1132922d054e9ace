// then-with-goto: `IF[..]THEN GOTO10`.
#include "findings/rule/rule.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::then_with_goto {
namespace {

/// Whoever writes it once writes it everywhere: the first one speaks for all.
void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.grammar.thenMayBeGoto)
    return;
  const auto isSame = [](const SyntaxIssue &other) { return other.kind == SyntaxIssueKind::ThenWithGoto; };
  const auto first = std::ranges::find_if(context.tree.issues, isSame);
  if (first->other != issue.other)
    return;
  Diagnostic found{.message = "`THEN` before `GOTO`",
                   .span = issue.other,
                   .labels = {{issue.span, "the jump"}},
                   .notes = {"some versions of the control stop here; `IF[..]GOTO n` works on all"},
                   .fixes = {{FixSafety::Safe, "remove `THEN`", {}}}};
  for (const SyntaxIssue &each : context.tree.issues)
    if (isSame(each))
      found.fixes.front().edits.push_back({each.other, ""});
  if (const std::size_t more = found.fixes.front().edits.size() - 1; more != 0)
    found.notes.push_back(
        fmt::format("{} more block{} of the file {} it", more, more == 1 ? "" : "s", more == 1 ? "has" : "have"));
  reporter.report(std::move(found));
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::ThenWithGoto};

} // namespace

extern const Rule thenWithGoto;
const Rule thenWithGoto{.info = {"then-with-goto", Category::Syntax, Severity::Warning,
                                 "Reports `THEN GOTO`: some versions of the control accept it, others stop."},
                        .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::then_with_goto
