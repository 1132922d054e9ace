// constant-condition: a condition of numbers alone.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include <fmt/format.h>

namespace feedhold::rules::constant_condition {
namespace {

/// What the control makes of a comparison of two numbers; absent when it is more than that.
std::optional<bool> outcome(const SyntaxTree &tree, ExpressionId condition) {
  const auto *operation = asInside<BinaryOperation>(tree, condition);
  const auto left = operation ? literalValue(tree, operation->left) : std::nullopt;
  const auto right = operation ? literalValue(tree, operation->right) : std::nullopt;
  if (!left || !right || !isRelation(operation->op))
    return std::nullopt;
  if (operation->op == OperatorKind::Equal)
    return *left == *right;
  if (operation->op == OperatorKind::NotEqual)
    return *left != *right;
  if (operation->op == OperatorKind::GreaterThan)
    return *left > *right;
  if (operation->op == OperatorKind::GreaterOrEqual)
    return *left >= *right;
  if (operation->op == OperatorKind::LessThan)
    return *left < *right;
  return *left <= *right;
}

/// `WHILE[1EQ1]DO1` is the usual way to write an endless loop.
bool isEndlessLoop(const Statement &statement, std::optional<bool> value) {
  return std::holds_alternative<While>(statement.node) && value.value_or(true);
}

std::string_view says(std::optional<bool> value) {
  if (!value)
    return "always gives the same result";
  return *value ? "is always true" : "is never true";
}

/// Of `o10 if [..]` and `o10 elseif [..]` too.
std::optional<ExpressionId> askedIn(const SyntaxTree &tree, const Statement &statement) {
  const auto *oWord = std::get_if<OWord>(&statement.node);
  if (oWord && (oWord->kind == OWordKind::If || oWord->kind == OWordKind::ElseIf) && oWord->argumentCount == 1)
    return tree.argumentsOf(*oWord).front();
  return conditionOf(statement);
}

void check(const Statement &statement, BlockId, const FileContext &context, const Reporter &reporter) {
  const auto condition = askedIn(context.tree, statement);
  if (!condition || !isConstant(context.tree, *condition))
    return;
  const auto value = outcome(context.tree, *condition);
  if (isEndlessLoop(statement, value))
    return;
  const Span span = context.tree.expressions[*condition].span;
  // `o10 if [0]` switches a part of the program off, and generators of programs write `o10 if [0 EQ 1]`.
  const bool isSwitch = std::holds_alternative<OWord>(statement.node);
  reporter.report({.message = fmt::format("{} {}", context.quoted(span), says(value)),
                   .span = span,
                   .notes = {"it contains no variable; a `#` may be missing"}},
                  isSwitch ? Severity::Info : Severity::Warning);
}

} // namespace

extern const Rule constantCondition;
const Rule constantCondition{.info = {"constant-condition", Category::Expression, Severity::Warning,
                                      "Reports a condition without any variable: it always gives the same result."},
                             .hooks = {.statement = check}};

} // namespace feedhold::rules::constant_condition
