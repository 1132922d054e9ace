// broken-expression: an operand or operator is missing.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules {
namespace {

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = issue.span.empty()
                                  ? std::string("the expression stops before its operand")
                                  : fmt::format("{} does not fit into the expression", context.quoted(issue.span)),
                   .span = issue.span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::ExpressionFormat))}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::BrokenExpression};

} // namespace

extern const Rule brokenExpression;
const Rule brokenExpression{.info = {"broken-expression", Category::Expression, Severity::Error,
                                     "Reports an expression that lacks an operand or an operator."},
                            .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules
