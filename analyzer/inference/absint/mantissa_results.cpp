// What a control whose mantissas may have 32 bits keeps of a result, by the error of the operation.
#include "inference/absint/abstract_interpretation.h"
#include "inference/domain/mantissa_number.h"

#include <cmath>

namespace feedhold {

namespace {

using ResultError = mantissa32::Error;

/// SIN / COS, each with its error: at T the cosine is at least 1 / sqrt(1 + T^2).
ResultError errorOfTangent(double largest) {
  const double secant = std::sqrt(1 + largest * largest);
  const double error = mantissa32::kErrorOfSine.absolute * (1 + largest) * secant;
  return mantissa32::kErrorOfSine.absolute * secant < 0.5 ? ResultError{0, 2 * error} : ResultError{0, INFINITY};
}

ResultError errorOf(FunctionKind function, const AbstractNumber &result) {
  switch (function) {
  case FunctionKind::Sin:
  case FunctionKind::Cos: return mantissa32::kErrorOfSine;
  case FunctionKind::Tan: return errorOfTangent(result.interval().largest());
  case FunctionKind::Asin:
  case FunctionKind::Acos:
  case FunctionKind::Atan: return mantissa32::kErrorOfAngle;
  case FunctionKind::Sqrt: return mantissa32::kErrorOfRoot;
  case FunctionKind::Ln:
  case FunctionKind::Exp:
  case FunctionKind::Pow: return mantissa32::kErrorOfOthers;
  case FunctionKind::Abs: // of a number that is held already, or whole
  case FunctionKind::Round:
  case FunctionKind::Fix:
  case FunctionKind::Fup:
  case FunctionKind::Bin:
  case FunctionKind::Bcd:
  case FunctionKind::Adp:
  case FunctionKind::Prm:
  case FunctionKind::Ax:
  case FunctionKind::AxNumber:
  case FunctionKind::Exists: break;
  }
  return {};
}

ResultError errorOf(const Expression &expression, const AbstractNumber &result) {
  if (const auto *call = std::get_if<FunctionCall>(&expression.node))
    return errorOf(call->function, result);
  const auto *operation = std::get_if<BinaryOperation>(&expression.node);
  if (!operation)
    return {}; // it is only rounded
  if (operation->op == OperatorKind::Multiply)
    return mantissa32::kErrorOfProduct;
  if (operation->op == OperatorKind::Divide)
    return mantissa32::kErrorOfQuotient;
  return operation->op == OperatorKind::Power ? mantissa32::kErrorOfOthers : ResultError{}; // of sums: holdSum()
}

/// A number of the program or of the control, not a result.
bool isCopy(const Expression &expression) {
  return !std::holds_alternative<BinaryOperation>(expression.node) &&
         !std::holds_alternative<FunctionCall>(expression.node) && !std::holds_alternative<Negation>(expression.node);
}

bool isSum(const Expression &expression) {
  const auto *operation = std::get_if<BinaryOperation>(&expression.node);
  return operation && (operation->op == OperatorKind::Add || operation->op == OperatorKind::Subtract);
}

} // namespace

void AbstractInterpretation::holdInMantissa32(Value &result, const Expression &expression) const {
  if (!result.mayBeNumber() || isSum(expression))
    return;
  const AbstractNumber &number = result.number();
  if (isCopy(expression)) {
    result = result.withNumber(
        memo_.of(NumberOperation::Held, number, {}, [&] { return heldInMantissa32(number, ResultError{}); }));
    return;
  }
  const AbstractNumber held = heldInMantissa32(number, errorOf(expression, number));
  if (!held.isCopyOf(number))
    result = result.withNumber(held).withOrigin(std::nullopt);
}

void AbstractInterpretation::holdSumInMantissa32(Value &sum, OperatorKind op, const Value &left,
                                                 const Value &right) const {
  if (fitsMantissa32(sum.number()))
    return;
  const bool isAdded = op == OperatorKind::Add;
  const AbstractNumber held = memo_.of(
      isAdded ? NumberOperation::HeldSum : NumberOperation::HeldDifference, left.number(), right.number(), [&] {
        const Interval &other = right.number().interval();
        return heldSumInMantissa32(sum.number(), left.number().interval(), isAdded ? other : feedhold::negate(other));
      });
  if (!held.isCopyOf(sum.number()))
    sum = sum.withNumber(held).withOrigin(std::nullopt);
}

} // namespace feedhold
