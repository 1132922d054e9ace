// expression-in-parentheses: `#1=(#2+1)*2`, `IF(#1EQ0)`.
#include "findings/rule/rule.h"

namespace feedhold::rules::expression_in_parentheses {
namespace {

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  const Span open{issue.span.begin, issue.span.begin + 1};
  const Span close{issue.span.end - 1, issue.span.end};
  reporter.report(
      {.message = context.quoted(issue.span) + " is a comment, not an expression",
       .span = issue.span,
       .notes = {"the control skips text in parentheses, so an operand is missing here",
                 "group expressions with brackets: `[#1+2]`"},
       .fixes = {{.title = "replace the parentheses with brackets", .edits = {{open, "["}, {close, "]"}}}}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::ExpressionInParentheses};

} // namespace

extern const Rule expressionInParentheses;
const Rule expressionInParentheses{
    .info = {"expression-in-parentheses", Category::Expression, Severity::Error,
             "Reports an expression in parentheses instead of brackets: to the control it is a comment."},
    .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::expression_in_parentheses
