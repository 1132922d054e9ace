#include "language/contract/constants.h"

#include "base/support/match.h"

namespace feedhold {

namespace {

class Folder {
public:
  Folder(const SyntaxTree &tree, const ValueOfVariable &valueOf) : tree_(tree), valueOf_(valueOf) {}

  std::optional<Rational> value(ExpressionId id) const {
    using Value = std::optional<Rational>;
    return match(
        tree_.expressions[id].node,
        [](const NumberLiteral &node) -> Value { return Rational::fromDecimal(node.value); },
        [&](const NumberedVariable &) -> Value { return variable(id); },
        [](const IndirectVariable &) -> Value { return std::nullopt; },
        [](const NamedVariable &) -> Value { return std::nullopt; },
        [&](const Negation &node) -> Value {
          const Value operand = value(node.operand);
          return operand ? negate(*operand) : std::nullopt;
        },
        [&](const Identity &node) -> Value { return value(node.operand); },
        [&](const Bracketed &node) -> Value { return value(node.inner); },
        [&](const BinaryOperation &node) -> Value { return binary(node); },
        [&](const FunctionCall &node) -> Value { return function(node); },
        [](const BrokenExpression &) -> Value { return std::nullopt; });
  }

  std::optional<bool> truth(ExpressionId id) const {
    const auto *operation = std::get_if<BinaryOperation>(&tree_.expressions[unwrapped(tree_, id)].node);
    if (!operation)
      return std::nullopt;
    if (operation->op == OperatorKind::And || operation->op == OperatorKind::Or || operation->op == OperatorKind::Xor)
      return joined(*operation);
    const std::optional<Rational> left = value(operation->left);
    const std::optional<Rational> right = value(operation->right);
    if (!left || !right)
      return std::nullopt;
    return compared(operation->op, *left <=> *right);
  }

private:
  std::optional<Rational> variable(ExpressionId id) const {
    const std::optional<std::uint32_t> number = variableNumber(tree_, id);
    return number && valueOf_ ? valueOf_(*number) : std::nullopt;
  }

  std::optional<Rational> function(const FunctionCall &call) const {
    if (call.function != FunctionKind::Abs || call.arguments().empty())
      return std::nullopt;
    const std::optional<Rational> argument = value(call.arguments()[0]);
    return argument && argument->isNegative() ? negate(*argument) : argument;
  }

  std::optional<Rational> binary(const BinaryOperation &operation) const {
    const std::optional<Rational> left = value(operation.left);
    const std::optional<Rational> right = value(operation.right);
    if (!left || !right)
      return std::nullopt;
    switch (operation.op) {
    case OperatorKind::Add: return add(*left, *right);
    case OperatorKind::Subtract: return subtract(*left, *right);
    case OperatorKind::Multiply: return multiply(*left, *right);
    case OperatorKind::Divide: return divide(*left, *right);
    case OperatorKind::Modulo:
    case OperatorKind::Power:
    case OperatorKind::And:
    case OperatorKind::Or:
    case OperatorKind::Xor:
    case OperatorKind::Equal:
    case OperatorKind::NotEqual:
    case OperatorKind::GreaterThan:
    case OperatorKind::GreaterOrEqual:
    case OperatorKind::LessThan:
    case OperatorKind::LessOrEqual: break;
    }
    return std::nullopt;
  }

  std::optional<bool> joined(const BinaryOperation &operation) const {
    const std::optional<bool> left = truth(operation.left);
    const std::optional<bool> right = truth(operation.right);
    if (operation.op == OperatorKind::And && (left == false || right == false))
      return false;
    if (operation.op == OperatorKind::Or && (left == true || right == true))
      return true;
    if (!left || !right)
      return std::nullopt;
    return operation.op == OperatorKind::Xor ? *left != *right : *left;
  }

  static std::optional<bool> compared(OperatorKind op, std::strong_ordering order) {
    switch (op) {
    case OperatorKind::Equal: return order == 0;
    case OperatorKind::NotEqual: return order != 0;
    case OperatorKind::GreaterThan: return order > 0;
    case OperatorKind::GreaterOrEqual: return order >= 0;
    case OperatorKind::LessThan: return order < 0;
    case OperatorKind::LessOrEqual: return order <= 0;
    case OperatorKind::Add:
    case OperatorKind::Subtract:
    case OperatorKind::Multiply:
    case OperatorKind::Divide:
    case OperatorKind::Modulo:
    case OperatorKind::Power:
    case OperatorKind::And:
    case OperatorKind::Or:
    case OperatorKind::Xor: break;
    }
    return std::nullopt;
  }

  const SyntaxTree &tree_;
  const ValueOfVariable &valueOf_;
};

} // namespace

std::optional<Rational> constantValue(const SyntaxTree &tree, ExpressionId expression, const ValueOfVariable &valueOf) {
  return Folder(tree, valueOf).value(expression);
}

std::optional<bool> constantTruth(const SyntaxTree &tree, ExpressionId condition, const ValueOfVariable &valueOf) {
  return Folder(tree, valueOf).truth(condition);
}

} // namespace feedhold
