// loop-in-wrong-direction: `WHILE[#1LT#2]` with `#1=#1-1` inside.
#include "rules/flow/loop_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::loop_in_wrong_direction {
namespace {

/// The variable that is compared with a limit, and whether the loop goes on while it is below.
struct Bound {
  std::uint32_t variable;
  ExpressionId limit;
  bool goesOnBelow;
};

std::optional<Bound> boundOf(const LoopExit &exit, const FlowFacts &facts) {
  const SyntaxTree &tree = *facts.file.tree;
  const auto *relation = asInside<BinaryOperation>(tree, exit.condition);
  if (!relation || !isRelation(relation->op) || relation->op == OperatorKind::Equal ||
      relation->op == OperatorKind::NotEqual)
    return std::nullopt;
  const bool below = relation->op == OperatorKind::LessThan || relation->op == OperatorKind::LessOrEqual;
  const auto variable = variableNumber(tree, unwrapped(tree, relation->left));
  if (!variable || !isPlain(facts.file, *variable))
    return std::nullopt;
  return Bound{*variable, relation->right, below != exit.leavesWhenTrue};
}

bool isFixed(ExpressionId limit, const LoopExit &exit, const LoopFlow &loop, const FlowFacts &facts) {
  const auto reads = readsIn(facts.file, limit, facts.node(exit.test).block);
  return std::ranges::all_of(reads, [&](const Read &read) {
    if (!read.number || !isPlain(facts.file, *read.number))
      return false;
    const auto writes = writesTo(facts, loop, *read.number);
    return writes && writes->empty();
  });
}

/// Every write in the loop moves the variable away from the limit.
bool movesAway(const Bound &bound, const std::vector<LoopWrite> &writes, const FlowFacts &facts) {
  return std::ranges::all_of(writes, [&](const LoopWrite &write) {
    const auto step = stepOf(facts, write.assignment, bound.variable);
    const AbstractValue *size = step ? facts.valueOf(step->size) : nullptr;
    if (!size || !size->isNumber())
      return false;
    const Interval &range = size->number().interval();
    const bool goesDown = step->isMinus ? range.lo > 0 : range.hi < 0;
    const bool goesUp = step->isMinus ? range.hi < 0 : range.lo > 0;
    return bound.goesOnBelow ? goesDown : goesUp;
  });
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  std::vector<NodeId> done;
  for (const LoopFlow &loop : loopsOf(facts)) {
    const LoopExit *only = onlyExit(loop);
    if (!only)
      continue;
    const LoopExit &exit = *only;
    const auto bound = boundOf(exit, facts);
    const auto writes = bound ? writesTo(facts, loop, bound->variable) : std::nullopt;
    if (!writes || writes->empty() || !isFixed(bound->limit, exit, loop, facts) || !movesAway(*bound, *writes, facts))
      continue;
    if (std::ranges::find(done, exit.test) != done.end())
      continue;
    done.push_back(exit.test);
    const Span span = context.tree.expressions[exit.condition].span;
    const Span step = context.tree.expressions[writes->front().assignment.target].span;
    const Span value = context.tree.expressions[writes->front().assignment.value].span;
    reporter.report({.message = fmt::format("this loop runs in the wrong direction: `#{}` goes {}, away from {}",
                                            bound->variable, bound->goesOnBelow ? "down" : "up",
                                            context.quoted(context.tree.expressions[bound->limit].span)),
                     .span = span,
                     .labels = {{cover(step, value), "the step"}},
                     .flow = pathFromEntry(facts, exit.test),
                     .notes = {fmt::format("{} once entered; reverse the comparison or the sign of the step",
                                           endlessnessOf(loop))}});
  }
}

} // namespace

extern const Rule loopInWrongDirection;
const Rule loopInWrongDirection{.info = {"loop-in-wrong-direction", Category::Flow, Severity::Warning,
                                         "Reports a loop whose counter moves away from the limit that ends it."},
                                .hooks = {.flow = check}};

} // namespace feedhold::rules::loop_in_wrong_direction
