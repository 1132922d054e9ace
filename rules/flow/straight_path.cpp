// See the header.
#include "rules/flow/straight_path.h"

#include "rules/flow/loop_view.h"

#include <cmath>

namespace feedhold::rules {

LinearForm sum(LinearForm left, double factor, const LinearForm &right) {
  left.constant += factor * right.constant;
  for (const auto &[number, share] : right.factors)
    if ((left.factors[number] += factor * share) == 0)
      left.factors.erase(number);
  return left;
}

StraightPath::StraightPath(const FlowFacts &facts, NodeId last, const std::function<bool(NodeId)> &goesOn)
    : facts_(facts), nodes_{last} {
  constexpr std::size_t kMostNodes = 200; // two places that belong together are near to each other
  while (nodes_.size() < kMostNodes) {
    const std::optional<NodeId> before = onlyPredecessor(facts, nodes_.back());
    if (!before || *before == last || !goesOn(*before))
      return;
    nodes_.push_back(*before);
  }
}

std::optional<LinearForm> StraightPath::formOf(ExpressionId id, std::size_t at) {
  constexpr int kMostSteps = 1000; // `#1=#1+#1` doubles the work each time
  if (++steps_ > kMostSteps)
    return std::nullopt;
  const SyntaxTree &tree = *facts_.file.tree;
  if (const auto literal = literalValue(tree, id))
    return LinearForm{literal->toDouble()};
  const AbstractValue *value = facts_.valueOf(id);
  if (value && value->isNumber())
    if (const auto constant = value->number().constantValue())
      return LinearForm{*constant};
  if (const auto variable = variableOf(facts_, id))
    return formOfVariable(*variable, id, at);
  const auto &node = tree.expressions[id].node;
  if (const auto *negation = std::get_if<Negation>(&node)) {
    const auto operand = formOf(negation->operand, at);
    return operand ? std::optional(sum({}, -1, *operand)) : std::nullopt;
  }
  if (const auto *identity = std::get_if<Identity>(&node))
    return formOf(identity->operand, at);
  if (const auto *bracketed = std::get_if<Bracketed>(&node))
    return formOf(bracketed->inner, at);
  if (const auto *operation = std::get_if<BinaryOperation>(&node))
    return formOf(*operation, id, at);
  return unknown({UnknownNumber::Kind::Expression, static_cast<std::uint32_t>(id.index())}, id);
}

std::optional<LinearForm> StraightPath::formOf(const BinaryOperation &operation, ExpressionId id, std::size_t at) {
  const auto left = formOf(operation.left, at);
  const auto right = left ? formOf(operation.right, at) : std::nullopt;
  if (!right)
    return std::nullopt;
  if (operation.op == OperatorKind::Add)
    return sum(*left, 1, *right);
  if (operation.op == OperatorKind::Subtract)
    return sum(*left, -1, *right);
  if (operation.op == OperatorKind::Multiply && left->isConstant())
    return sum({}, left->constant, *right);
  if (operation.op == OperatorKind::Multiply && right->isConstant())
    return sum({}, right->constant, *left);
  if (operation.op == OperatorKind::Divide && right->isConstant() && right->constant != 0)
    return sum({}, 1 / right->constant, *left);
  return unknown({UnknownNumber::Kind::Expression, static_cast<std::uint32_t>(id.index())}, id);
}

std::optional<LinearForm> StraightPath::formOfVariable(std::uint32_t variable, ExpressionId id, std::size_t at) {
  const AbstractValue *value = facts_.valueOf(id);
  if (!value || value->isVacant())
    return std::nullopt;
  for (std::size_t before = at + 1; before < nodes_.size(); ++before) {
    const auto assignment = assignmentTo(facts_, nodes_[before], variable);
    if (!assignment)
      continue;
    if (const auto form = formOf(assignment->value, before))
      return form;
    return std::nullopt;
  }
  if (const auto &origin = value->origin()) {
    const auto form = unknown({UnknownNumber::Kind::Symbol, origin->symbol}, id);
    return form ? std::optional(sum(*form, 1, {origin->offset.toDouble()})) : std::nullopt;
  }
  if (variable < kFirstNamedVariable && !isPlain(facts_.file, variable))
    return std::nullopt; // two reads may find two numbers
  return unknown({UnknownNumber::Kind::Variable, variable}, id);
}

/// As the value of the expression, less the distance that a symbol is away from it.
std::optional<LinearForm> StraightPath::unknown(UnknownNumber number, ExpressionId id) {
  const AbstractValue *value = facts_.valueOf(id);
  if (!value || value->isVacant())
    return std::nullopt;
  Interval range = value->isNumber() ? value->number().interval() : Interval::all();
  if (number.kind == UnknownNumber::Kind::Symbol)
    range = subtract(range, Interval::of(value->origin()->offset));
  const auto [known, isNew] = ranges_.try_emplace(number, range);
  if (!isNew)
    known->second = meet(known->second, range).value_or(known->second);
  return LinearForm{0, {{number, 1}}};
}

Interval StraightPath::rangeOf(const LinearForm &form) const {
  Interval range = Interval::constant(form.constant);
  for (const auto &[number, factor] : form.factors)
    range = add(range, multiply(Interval::constant(factor), ranges_.at(number)));
  return range;
}

} // namespace feedhold::rules
