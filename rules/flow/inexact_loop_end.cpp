// inexact-loop-end: a loop that ends when a sum of 0.1 is EQ to its limit.
#include "rules/flow/loop_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::inexact_loop_end {
namespace {

/// 0.1 has no exact value in a binary number; 0.5 and 0.25 have.
bool isInexact(const Decimal &value) {
  double scaled = value.toDouble();
  for (int i = 0; i < 20; ++i)
    scaled *= 2;
  return scaled != static_cast<double>(static_cast<std::int64_t>(scaled));
}

/// The loop goes on until the comparison says equal: the variable.
std::optional<std::uint32_t> endsAtEqual(const FlowFacts &facts, const LoopExit &exit) {
  const SyntaxTree &tree = *facts.file.tree;
  const auto *relation = asInside<BinaryOperation>(tree, exit.condition);
  if (!relation || relation->op != (exit.leavesWhenTrue ? OperatorKind::Equal : OperatorKind::NotEqual))
    return std::nullopt;
  return variableNumber(tree, unwrapped(tree, relation->left));
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  std::vector<NodeId> done;
  for (const LoopFlow &loop : loopsOf(facts)) {
    if (!loop.exitsAreKnown || loop.exits.size() != 1 || context.dialect.behaviour.equalTolerance > 0)
      continue;
    const LoopExit &exit = loop.exits.front();
    const auto variable = endsAtEqual(facts, exit);
    const auto writes = variable ? writesTo(facts, loop, *variable) : std::nullopt;
    const auto step =
        writes && writes->size() == 1 ? stepOf(facts, writes->front().assignment, *variable) : std::nullopt;
    const auto size = step ? literalValue(context.tree, step->size) : std::nullopt;
    if (!size || !isInexact(*size) || std::ranges::find(done, exit.test) != done.end())
      continue;
    done.push_back(exit.test);
    reporter.report(
        {.message = fmt::format(
             "this loop may never end: it needs `#{}` to match exactly, but the step is not exact in binary",
             *variable),
         .span = context.tree.expressions[exit.condition].span,
         .labels = {{context.tree.expressions[step->size].span, "each iteration adds a rounding error"}},
         .notes = {"the sum may step past the limit without ever being equal to it",
                   "compare with GT, GE, LT or LE, or count iterations in whole numbers"}});
  }
}

} // namespace

extern const Rule inexactLoopEnd;
const Rule inexactLoopEnd{
    .info = {"inexact-loop-end", Category::Flow, Severity::Warning,
             "Reports a loop that ends only when a sum of inexact steps exactly equals its limit."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::inexact_loop_end
