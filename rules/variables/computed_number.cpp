// Variables whose number the program computes.
#include "rules/variables/computed_number.h"

#include "rules/expressions/expression_view.h"

#include <cmath>

namespace feedhold::rules {
namespace {

constexpr double kFirstNumber = -0.5; // rounds to 0
constexpr double kLastNumber = 1e9;

/// Whole numbers near enough: `#[#1]` rounds.
std::vector<std::uint32_t> roundedAll(std::span<const double> values) {
  std::vector<std::uint32_t> numbers;
  for (const double value : values) {
    if (value < kFirstNumber || value > kLastNumber)
      return {};
    numbers.push_back(static_cast<std::uint32_t>(std::floor(value + 0.5)));
  }
  return numbers;
}

} // namespace

std::vector<ComputedNumber> computedNumbersOf(const FlowFacts &facts) {
  std::vector<ComputedNumber> found;
  const SyntaxTree &tree = *facts.file.tree;
  for (const VariableUse &use : facts.file.model->variables) {
    if (!facts.file.model->programs[facts.program].contains(use.block))
      continue;
    const auto *indirect = as<IndirectVariable>(tree, use.expression);
    const AbstractValue *index = indirect && !use.number ? facts.valueOf(indirect->index) : nullptr;
    const auto node = index && index->isNumber() ? reachedNode(facts, use.block) : std::nullopt;
    if (!node)
      continue;
    ComputedNumber computed{tree.expressions[use.expression].span, *node, use.write, false, {}};
    computed.isNegative = index->number().interval().hi < kFirstNumber;
    computed.numbers = roundedAll(index->number().set().values());
    if (computed.isNegative || !computed.numbers.empty())
      found.push_back(std::move(computed));
  }
  return found;
}

} // namespace feedhold::rules
