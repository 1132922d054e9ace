// statement-format: `DPRNT` or `SETVN` without its brackets.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

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

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::StatementFormat};

} // namespace

extern const Rule statementFormat;
const Rule statementFormat{.info = {"statement-format", Category::Structure, Severity::Error,
                                    "Reports an incomplete `SETVN`, `BPRNT` or `DPRNT` statement."},
                           .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::statement_format
