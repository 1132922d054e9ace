// goto-without-target: `GOTO` alone.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

namespace feedhold::rules::goto_without_target {
namespace {

/// The `N` of `GOTO N10`: the number is there, and a letter too many.
std::optional<Span> letterBefore(std::uint32_t end, std::string_view text) {
  const std::size_t letter = text.find_first_not_of(" \t", end);
  if (letter == std::string_view::npos || toUpper(text[letter]) != 'N')
    return std::nullopt;
  const std::size_t digit = text.find_first_not_of(" \t", letter + 1);
  if (digit == std::string_view::npos || !isDigit(text[digit]))
    return std::nullopt;
  const auto begin = static_cast<std::uint32_t>(letter);
  return Span{begin, begin + 1};
}

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  Diagnostic found{.message = "this GOTO has no sequence number",
                   .span = issue.span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::SequenceNotFound))}};
  if (const auto letter = letterBefore(issue.span.end, context.source.text())) {
    found.message = "GOTO takes the number alone, without `N`";
    found.fixes = {{FixSafety::Safe, "remove the `N`", {{*letter, ""}}}};
  }
  reporter.report(std::move(found));
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::GotoWithoutTarget};

} // namespace

extern const Rule gotoWithoutTarget;
const Rule gotoWithoutTarget{.info = {"goto-without-target", Category::Syntax, Severity::Error,
                                      "Reports a `GOTO` without a sequence number, or with an `N` before it."},
                             .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::goto_without_target
