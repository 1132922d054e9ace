// missing-value: `X` alone.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

namespace feedhold::rules::missing_value {
namespace {

/// `X?` is how templates mark a number to be filled in.
bool isPlaceholder(std::string_view rest) {
  const std::string_view next = trimmed(rest);
  return !next.empty() && next.front() == '?';
}

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (isPlaceholder(context.text({issue.span.end, context.tree.blocks[context.tree.blockAt(issue.span.begin)].end})))
    return;
  reporter.report(
      {.message = fmt::format("{} has no number", context.quoted(issue.span)),
       .span = issue.span,
       .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::NoDataAfterAddress))}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::MissingValue};

} // namespace

extern const Rule missingValue;
const Rule missingValue{
    .info = {"missing-value", Category::Word, Severity::Error, "Reports an address without a number."},
    .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::missing_value
