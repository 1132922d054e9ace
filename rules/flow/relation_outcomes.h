// Comparisons of the same two operands as sets of outcomes: what one says of another.
#pragma once

#include "rules/flow/flow_view.h"

#include <utility>

namespace feedhold::rules {

/// The outcomes as bits: left is less, equal, greater.
inline unsigned outcomesOf(OperatorKind relation) {
  if (relation == OperatorKind::LessThan)
    return 1;
  if (relation == OperatorKind::Equal)
    return 2;
  if (relation == OperatorKind::LessOrEqual)
    return 3;
  if (relation == OperatorKind::GreaterThan)
    return 4;
  return relation == OperatorKind::NotEqual ? 5 : 6;
}

/// Of the relation with its operands exchanged.
inline unsigned outcomesTurned(unsigned outcomes) {
  return ((outcomes & 1U) << 2U) | (outcomes & 2U) | ((outcomes & 4U) >> 2U);
}

/// The comparison that an expression is.
inline const BinaryOperation *relationIn(const SyntaxTree &tree, ExpressionId id) {
  const auto *relation = asInside<BinaryOperation>(tree, id);
  return relation && isRelation(relation->op) ? relation : nullptr;
}

/// The outcomes of two comparisons, seen from the operands of the first; absent where their operands are not the same
/// by the text.
inline std::optional<std::pair<unsigned, unsigned>>
outcomesOfBoth(const FileContext &context, const BinaryOperation &first, const BinaryOperation &second) {
  const auto isSame = [&](ExpressionId left, ExpressionId right) {
    const auto spanOf = [&](ExpressionId id) { return context.tree.expressions[unwrapped(context.tree, id)].span; };
    return sameText(context, spanOf(left), spanOf(right));
  };
  if (isSame(first.left, second.left) && isSame(first.right, second.right))
    return std::pair{outcomesOf(first.op), outcomesOf(second.op)};
  if (isSame(first.left, second.right) && isSame(first.right, second.left))
    return std::pair{outcomesOf(first.op), outcomesTurned(outcomesOf(second.op))};
  return std::nullopt;
}

} // namespace feedhold::rules
