// do-number: `DO4`, `DO#1`, `DO` alone.
#include "rules/structure/structure_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::do_number {
namespace {

std::string stops(const FileContext &context) {
  return fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::LoopNumber));
}

void checkMissing(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (const auto word = endWhileAt(context, issue.span)) {
    reporter.report({.message = fmt::format("{} ends no loop on this control", context.quoted(*word)),
                     .span = *word,
                     .notes = {stops(context), "write `DO1` behind the condition, and `END1` here"}});
    return;
  }
  reporter.report({.message = fmt::format("{} has no loop number", context.quoted(issue.span)),
                   .span = issue.span,
                   .notes = {stops(context), "write the number: `DO1` .. `END1`; DO and END are paired by it"}});
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

/// An END with the number of the DO before it: what is wrong with it is said there.
bool repeatsDo(const Statement &statement, ExpressionId number, BlockId block, const FileContext &context) {
  if (!std::holds_alternative<End>(statement.node))
    return false;
  const std::string_view text = context.text(context.tree.expressions[number].span);
  const auto loops = context.model.loopsOf(context.model.programOf(block));
  return std::ranges::any_of(loops, [&](const Loop &loop) {
    const auto its = numberOf(context.tree.statements[loop.doStatement]);
    return its && loop.doBlock < block && context.text(context.tree.expressions[*its].span) == text;
  });
}

void check(const Statement &statement, BlockId block, const FileContext &context, const Reporter &reporter) {
  const auto number = numberOf(statement);
  if (!number || std::holds_alternative<BrokenExpression>(context.tree.expressions[*number].node) ||
      repeatsDo(statement, *number, block, context))
    return;
  const unsigned last = context.dialect.limits.lastLoopNumber;
  const auto value = literalValue(context.tree, *number);
  const Span span = context.tree.expressions[*number].span;
  if (!value) {
    reporter.report({.message = fmt::format("loop number {} is not a plain number", context.quoted(span)),
                     .span = span,
                     .notes = {stops(context), "DO and END take a plain number only, no variable or expression"}});
    return;
  }
  const bool fits = value->isInteger() && Decimal::fromInteger(1) <= *value && *value <= Decimal::fromInteger(last);
  if (!fits)
    reporter.report(
        {.message = fmt::format("loop number {} does not exist; this control has 1 to {}", value->toString(), last),
         .span = span,
         .notes = {stops(context), "reuse a number of a loop that does not enclose this one"}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::DoWithoutNumber};

} // namespace

extern const Rule doNumber;
const Rule doNumber{
    .info = {"do-number", Category::Structure, Severity::Error,
             "Reports a `DO` or `END` whose number is missing, computed, or not available on the control."},
    .hooks = {.issue = checkMissing, .issueKinds = kIssues, .statement = check}};

} // namespace feedhold::rules::do_number
