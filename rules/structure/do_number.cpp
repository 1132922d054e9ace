// do-number: `DO4`, `DO#1`, `DO` alone.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules {
namespace {

std::string stops(const FileContext &context) {
  return fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::LoopNumber));
}

void checkMissing(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = fmt::format("{} without a number", context.quoted(issue.span)),
                   .span = issue.span,
                   .notes = {stops(context), "DO and END find each other by their number"}});
}

std::optional<ExpressionId> numberOf(const Statement &statement) {
  if (const auto *loop = std::get_if<While>(&statement.node))
    return loop->number;
  if (const auto *loop = std::get_if<Do>(&statement.node))
    return loop->number;
  if (const auto *end = std::get_if<End>(&statement.node))
    return end->number;
  return std::nullopt;
}

void check(const Statement &statement, BlockId, const FileContext &context, const Reporter &reporter) {
  const auto number = numberOf(statement);
  if (!number || std::holds_alternative<BrokenExpression>(context.tree.expressions[*number].node))
    return;
  const unsigned last = context.dialect.limits.lastLoopNumber;
  const auto value = literalValue(context.tree, *number);
  const Span span = context.tree.expressions[*number].span;
  if (!value) {
    reporter.report({.message = fmt::format("the loop number {} is computed", context.quoted(span)),
                     .span = span,
                     .notes = {stops(context), "DO and END take a number only"}});
    return;
  }
  const bool fits = value->isInteger() && Decimal::fromInteger(1) <= *value && *value <= Decimal::fromInteger(last);
  if (!fits)
    reporter.report(
        {.message = fmt::format("loop number {} where only 1 to {} exist", value->toString(), last),
         .span = span,
         .notes = {stops(context), "a number may be used again for a loop that does not enclose this one"}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::DoWithoutNumber};

} // namespace

extern const Rule doNumber;
const Rule doNumber{.info = {"do-number", Category::Structure, Severity::Error,
                             "Reports a `DO` or `END` whose number the control does not have."},
                    .hooks = {.issue = checkMissing, .issueKinds = kIssues, .statement = check}};

} // namespace feedhold::rules
