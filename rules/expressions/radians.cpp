// radians: `SIN[#1*3.14159/180]`.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace feedhold::rules::radians {
namespace {

struct Factor {
  double value;
  double tolerance;
};
constexpr Factor kPi{3.14159265, 0.002};                // 3.14 and better
constexpr Factor kRadiansInDegree{0.01745329, 0.00005}; // 0.0174 and better
constexpr Factor kDegreesInRadian{57.2957795, 0.05};    // 57.3 and better

bool isFactor(const SyntaxTree &tree, ExpressionId id, Factor factor) {
  const auto value = literalValue(tree, id);
  return value && std::abs(value->toDouble() - factor.value) < factor.tolerance;
}

/// Pi divides an angle when it turns radians into degrees, which is right; it multiplies when it makes radians.
bool makesRadians(const SyntaxTree &tree, ExpressionId id) {
  const auto *operation = as<BinaryOperation>(tree, id);
  if (!operation)
    return false;
  const auto multiplies = [&](ExpressionId side) {
    return isFactor(tree, side, kPi) || isFactor(tree, side, kRadiansInDegree);
  };
  if (operation->op == OperatorKind::Multiply)
    return multiplies(operation->left) || multiplies(operation->right);
  return operation->op == OperatorKind::Divide &&
         (multiplies(operation->left) || isFactor(tree, operation->right, kDegreesInRadian));
}

bool givesAngle(const SyntaxTree &tree, ExpressionId id) {
  const auto *call = as<FunctionCall>(tree, id);
  return call && (call->function == FunctionKind::Atan || call->function == FunctionKind::Asin ||
                  call->function == FunctionKind::Acos);
}

/// The first inverse function among the factors of a product.
std::optional<ExpressionId> angleIn(const SyntaxTree &tree, ExpressionId id) {
  const ExpressionId inner = unwrapped(tree, id);
  if (givesAngle(tree, inner))
    return inner;
  const auto *operation = as<BinaryOperation>(tree, inner);
  if (!operation || (operation->op != OperatorKind::Multiply && operation->op != OperatorKind::Divide))
    return std::nullopt;
  const auto left = angleIn(tree, operation->left);
  return left || operation->op == OperatorKind::Divide ? left : angleIn(tree, operation->right);
}

/// The product of the constant factors of a product or quotient, parts that are constant as a whole included.
double constantFactor(const SyntaxTree &tree, ExpressionId id) {
  const ExpressionId inner = unwrapped(tree, id);
  if (const auto value = literalValue(tree, inner))
    return value->toDouble();
  const auto *operation = as<BinaryOperation>(tree, inner);
  if (!operation || (operation->op != OperatorKind::Multiply && operation->op != OperatorKind::Divide))
    return 1;
  const double left = constantFactor(tree, operation->left);
  const double right = constantFactor(tree, operation->right);
  return operation->op == OperatorKind::Multiply ? left * right : left / right;
}

bool isProduct(const SyntaxTree &tree, ExpressionId id) {
  const auto *operation = asInside<BinaryOperation>(tree, id);
  return operation && (operation->op == OperatorKind::Multiply || operation->op == OperatorKind::Divide);
}

/// `ATAN[..]*180/3.14`, `ATAN[..]*57.3`, `[180/3.14]*ATAN[..]`: from radians to degrees, which it is already.
void checkResult(ExpressionId id, const FileContext &context, const Reporter &reporter) {
  const auto *operation = as<BinaryOperation>(context.tree, id);
  const bool byPi = operation && operation->op == OperatorKind::Divide && isFactor(context.tree, operation->right, kPi);
  // Of the parts of a product, only the first one is told.
  const auto *left = operation ? asInside<BinaryOperation>(context.tree, operation->left) : nullptr;
  const bool isTold = left && left->op == OperatorKind::Divide && isFactor(context.tree, left->right, kPi);
  const double factor = operation && isProduct(context.tree, id) ? constantFactor(context.tree, id) : 1;
  const auto isDegrees = [](double value) {
    return std::abs(value - kDegreesInRadian.value) < kDegreesInRadian.tolerance;
  };
  const bool byFactor =
      !isTold && isDegrees(factor) &&
      (!angleIn(context.tree, operation->left) || !isDegrees(constantFactor(context.tree, operation->left)));
  const auto angle = byPi || byFactor ? angleIn(context.tree, id) : std::nullopt;
  if (!angle)
    return;
  const auto function = as<FunctionCall>(context.tree, *angle)->function;
  reporter.report(
      {.message = fmt::format("`{}` gives degrees, but its result is converted to degrees", spellingOf(function)),
       .span = context.tree.expressions[id].span,
       .labels = {{context.tree.expressions[*angle].span, "degrees"}},
       .notes = {"the control raises no alarm: it computes with an angle about 57 times too large",
                 "delete the factor"}});
}

void check(ExpressionId id, BlockId, const FileContext &context, const Reporter &reporter) {
  checkResult(id, context, reporter);
  const auto *call = as<FunctionCall>(context.tree, id);
  const bool takesAngle = call && !call->arguments().empty() &&
                          (call->function == FunctionKind::Sin || call->function == FunctionKind::Cos ||
                           call->function == FunctionKind::Tan);
  if (!takesAngle)
    return;
  const auto parts = subexpressions(context.tree, call->arguments().front());
  const auto found =
      std::find_if(parts.begin(), parts.end(), [&](ExpressionId part) { return makesRadians(context.tree, part); });
  if (found == parts.end())
    return;
  reporter.report(
      {.message = fmt::format("`{}` takes degrees, but this angle is in radians", spellingOf(call->function)),
       .span = context.tree.expressions[*found].span,
       .labels = {{context.tree.expressions[id].span, ""}},
       .notes = {"the control raises no alarm: it computes with an angle about 57 times too small"}});
}

} // namespace

extern const Rule radians;
const Rule radians{.info = {"radians", Category::Expression, Severity::Warning,
                            "Reports an angle that is converted to radians before `SIN`, `COS` or `TAN`, or from "
                            "radians behind `ATAN`: the control computes in degrees."},
                   .hooks = {.expression = check, .expressionNodes = nodeSet<FunctionCall, BinaryOperation>()}};

} // namespace feedhold::rules::radians
