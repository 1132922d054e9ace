// bitwise-on-coordinate: `IF[[#5041AND#1]NE0]`: the bits of a position.
#include "rules/expressions/expression_view.h"
#include "rules/flow/system_variables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace feedhold::rules::bitwise_on_coordinate {
namespace {

/// What is in millimetres or inches, or has places behind the point by its nature.
bool isReal(ExpressionId id, const FileContext &context) {
  if (const auto literal = literalValue(context.tree, id))
    return !literal->asInteger();
  if (const auto variable = variableNumber(context.tree, unwrapped(context.tree, id))) {
    const VariableRole role = roleOf(context, *variable);
    return isPosition(role) || role == VariableRole::SkipPosition || isOffset(context, *variable);
  }
  constexpr std::array kReal = {FunctionKind::Sin,  FunctionKind::Cos,  FunctionKind::Tan,
                                FunctionKind::Asin, FunctionKind::Acos, FunctionKind::Atan,
                                FunctionKind::Sqrt, FunctionKind::Ln,   FunctionKind::Exp};
  const auto *call = asInside<FunctionCall>(context.tree, id);
  return call && std::ranges::find(kReal, call->function) != kReal.end();
}

void check(ExpressionId id, BlockId, const FileContext &context, const Reporter &reporter) {
  const auto *operation = as<BinaryOperation>(context.tree, id);
  if (!operation || !isBitwise(operation->op) || context.dialect.behaviour.logic != LogicMeaning::Bitwise)
    return;
  const bool onLeft = isReal(operation->left, context);
  if (!onLeft && !isReal(operation->right, context))
    return;
  const Span operand = context.tree.expressions[onLeft ? operation->left : operation->right].span;
  reporter.report({.message = fmt::format("`{}` works on the bits of integers, and {} has decimal places",
                                          spellingOf(operation->op), context.quoted(operand)),
                   .span = operation->opSpan,
                   .labels = {{operand, "a real number"}},
                   .notes = {"the control uses the bits of a rounded number, or stops where it is negative",
                             fmt::format("to ask for two conditions, compare each: `[#1 NE 0] {} [#2 NE 0]`",
                                         spellingOf(operation->op))}});
}

} // namespace

extern const Rule bitwiseOnCoordinate;
const Rule bitwiseOnCoordinate{
    .info = {"bitwise-on-coordinate", Category::Expression, Severity::Warning,
             "Reports `AND`, `OR` or `XOR` with a position, an offset or another number with decimal places."},
    .hooks = {.expression = check, .expressionNodes = nodeSet<BinaryOperation>()}};

} // namespace feedhold::rules::bitwise_on_coordinate
