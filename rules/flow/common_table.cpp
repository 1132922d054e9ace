#include "rules/flow/common_table.h"

namespace feedhold::rules {
namespace {

/// A literal among the terms: of `600+[#41-65]*20`, 600.
std::optional<std::uint32_t> baseIn(const SyntaxTree &tree, ExpressionId sum) {
  for (const SumTerm &term : termsOf(tree, sum)) {
    const auto value = literalValue(tree, term.value);
    if (value && !term.isMinus && value->isInteger() && *value > Decimal(kLocalVariables, 0) &&
        *value < Decimal(1'000'000, 0))
      return static_cast<std::uint32_t>(value->toDouble());
  }
  return std::nullopt;
}

} // namespace

std::optional<std::uint32_t> tableBase(const FlowFacts &facts, ExpressionId variable) {
  const SyntaxTree &tree = *facts.file.tree;
  const auto *indirect = asInside<IndirectVariable>(tree, variable);
  if (!indirect)
    return std::nullopt;
  if (const auto base = baseIn(tree, indirect->index))
    return base;
  for (const SumTerm &term : termsOf(tree, indirect->index)) {
    const auto number = term.isMinus ? std::nullopt : variableNumber(tree, unwrapped(tree, term.value));
    for (NodeId node = facts.entry(); number && node < facts.end(); node = node.next())
      if (const auto assignment = assignmentTo(facts, node, *number))
        if (const auto base = baseIn(tree, assignment->value))
          return base;
  }
  return std::nullopt;
}

} // namespace feedhold::rules
