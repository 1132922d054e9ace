// missing-equals: a statement without `=`.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::missing_equals {
namespace {

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  const bool replaces = !issue.span.empty();
  const std::string seen = replaces ? fmt::format("write `=` instead of {}", context.quoted(issue.span)) : "insert `=`";
  reporter.report({.message = fmt::format("{} is a statement without `=`", context.quoted(issue.other)),
                   .span = issue.other,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::MissingEquals))},
                   .fixes = {{.title = seen, .edits = {{issue.span, "="}}}}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::MissingEquals};

} // namespace

extern const Rule missingEquals;
const Rule missingEquals{
    .info =
        {"missing-equals", Category::Expression, Severity::Error,
         "Reports an expression where a macro statement is expected: its `=` is missing or was typed as another sign."},
    .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::missing_equals
