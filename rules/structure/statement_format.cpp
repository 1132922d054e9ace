// statement-format: `DPRNT` or `SETVN` without its brackets.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <string>

namespace feedhold::rules::statement_format {
namespace {

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  const bool names = toUpper(context.text(issue.span)).starts_with('S');
  const std::string_view form = names ? "`SETVN 500[NAME,NAME]`" : "`DPRNT[X#1[44]]`";
  const AlarmKind alarm = names ? AlarmKind::SetVnFormat : AlarmKind::PrintFormat;
  reporter.report({.message = fmt::format("{} is incomplete", context.quoted(issue.span)),
                   .span = issue.span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, alarm)),
                             fmt::format("the complete form is {}", form)}});
}

constexpr std::size_t kLongestName = 8; // PS1142

/// `SETVN 500[WIDTHOFPART]`
void checkNames(const Statement &statement, BlockId, const FileContext &context, const Reporter &reporter) {
  const std::string text = toUpper(context.text(statement.span));
  const std::size_t open = text.find('[');
  if (!context.dialect.hasFanucParameters || !text.starts_with("SETVN") || open == std::string::npos)
    return;
  std::size_t begin = open + 1;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find_first_of(",]", begin), text.size());
    const std::string_view name = trimmed(std::string_view(text).substr(begin, end - begin));
    if (name.size() > kLongestName) {
      const auto at = static_cast<std::uint32_t>(statement.span.begin + begin);
      const Span span{at, static_cast<std::uint32_t>(at + (end - begin))};
      reporter.report({.message = fmt::format("the name {} has {} characters", context.quoted(span), name.size()),
                       .span = span,
                       .notes = {fmt::format("the control stops with PS1142: a name has at most {}", kLongestName)}});
    }
    begin = end + 1;
  }
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::StatementFormat};

} // namespace

extern const Rule statementFormat;
const Rule statementFormat{
    .info = {"statement-format", Category::Structure, Severity::Error,
             "Reports an incomplete `SETVN`, `BPRNT` or `DPRNT` statement, and a name in `SETVN` that is "
             "too long."},
    .hooks = {.issue = check, .issueKinds = kIssues, .statement = checkNames}};

} // namespace feedhold::rules::statement_format
