// number-too-long: `0.000000001` on a control of eight digits.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include "base/support/text.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::number_too_long {
namespace {

void tooLong(Span span, std::string seen, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = std::move(seen),
                   .span = span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::TooManyDigits))}});
}

void checkNode(ExpressionId id, BlockId, const FileContext &context, const Reporter &reporter) {
  const std::size_t limit = context.dialect.limits.literalDigits;
  const Span span = context.tree.expressions[id].span;
  if (span.size() <= limit || !as<NumberLiteral>(context.tree, id))
    return;
  const std::string_view text = context.text(span);
  const auto digits = static_cast<std::size_t>(std::count_if(text.begin(), text.end(), isDigit));
  if (digits > limit)
    tooLong(span, fmt::format("{} has {} digits; this control reads at most {}", context.quoted(span), digits, limit),
            context, reporter);
}

void checkIssue(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  tooLong(issue.span, fmt::format("{} has more digits than any control reads", context.quoted(issue.span)), context,
          reporter);
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::NumberTooLong};

} // namespace

extern const Rule numberTooLong;
const Rule numberTooLong{.info = {"number-too-long", Category::Expression, Severity::Error,
                                  "Reports a number in a macro statement or expression with more digits than the "
                                  "control reads, zeros included."},
                         .hooks = {.issue = checkIssue,
                                   .issueKinds = kIssues,
                                   .expression = checkNode,
                                   .expressionNodes = nodeSet<NumberLiteral>()}};

} // namespace feedhold::rules::number_too_long
