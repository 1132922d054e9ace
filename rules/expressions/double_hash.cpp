// double-hash: `##1` instead of `#[#1]`.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

namespace feedhold::rules::double_hash {
namespace {

/// The end of the digits, and blanks between them, behind `##`; `begin` when there are none.
std::uint32_t endOfNumber(std::string_view text, std::uint32_t begin) {
  std::uint32_t end = begin;
  for (std::uint32_t at = begin; at < text.size() && (isBlank(text[at]) || isDigit(text[at])); ++at)
    if (isDigit(text[at]))
      end = at + 1;
  return end;
}

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  Diagnostic found{.message = "`##` is not a variable: brackets are missing",
                   .span = issue.span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WordFormat)),
                             "the variable whose number is in `#1` is written `#[#1]`"}};
  const std::uint32_t end = endOfNumber(context.source.text(), issue.span.end);
  if (end > issue.span.end)
    found.fixes = {{FixSafety::Safe, "write `#[#..]`", {{issue.span, "#[#"}, {{end, end}, "]"}}}};
  reporter.report(std::move(found));
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::DoubleHash};

} // namespace

extern const Rule doubleHash;
const Rule doubleHash{.info = {"double-hash", Category::Expression, Severity::Error,
                               "Reports `##1`: a variable whose number is in a variable needs brackets."},
                      .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::double_hash
