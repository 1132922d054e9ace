// broken-expression: an operand or operator is missing.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

namespace feedhold::rules::broken_expression {
namespace {

std::string whatIsWrong(Span span, const FileContext &context) {
  if (span.empty())
    return "an operand is missing here";
  const std::string_view before = trimmed(context.source.text().substr(0, span.begin));
  if (context.text(span) == "]" && before.ends_with('['))
    return "these brackets are empty";
  return fmt::format("unexpected {} in this expression", context.quoted(span));
}

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = whatIsWrong(issue.span, context),
                   .span = issue.span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::ExpressionFormat))}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::BrokenExpression};

} // namespace

extern const Rule brokenExpression;
const Rule brokenExpression{.info = {"broken-expression", Category::Expression, Severity::Error,
                                     "Reports an expression that lacks an operand or an operator."},
                            .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::broken_expression
