// The loop is run through with both results of each number.
#include "rules/flow/loop_count.h"

#include <algorithm>

namespace feedhold::rules {

bool passesAlways(const FlowFacts &facts, const LoopFlow &loop, NodeId node) {
  std::vector<NodeId> open{loop.head};
  std::vector<NodeId> seen;
  while (!open.empty()) {
    const NodeId from = open.back();
    open.pop_back();
    bool comesBack = false;
    forEachSuccessor(facts.file.cfg, *facts.file.model, from, ProgramUse::Called, [&](NodeId next) {
      if (next == node || !std::ranges::binary_search(loop.nodes, next))
        return;
      comesBack = comesBack || next == loop.head;
      if (std::ranges::find(seen, next) == seen.end()) {
        seen.push_back(next);
        open.push_back(next);
      }
    });
    if (comesBack)
      return false;
  }
  return true;
}

std::optional<LoopEnd> endOf(Formulas &formulas, const LoopFlow &loop, const LoopExit &exit) {
  const FlowFacts &facts = formulas.facts();
  const auto *relation = asInside<BinaryOperation>(*facts.file.tree, exit.condition);
  if (!relation || !isRelation(relation->op))
    return std::nullopt;
  const auto left = formulas.of(relation->left, exit.test);
  const auto right = left ? formulas.of(relation->right, exit.test) : std::nullopt;
  if (!right)
    return std::nullopt;
  std::vector<FormulaInputId> inputs = formulas.inputsOf(*left);
  const std::size_t onLeft = inputs.size();
  const auto others = formulas.inputsOf(*right);
  inputs.insert(inputs.end(), others.begin(), others.end());
  const auto counts = [&](FormulaInputId id) { return formulas.input(id).counter.has_value(); };
  const auto counter = std::ranges::find_if(inputs, counts);
  if (counter == inputs.end() || std::ranges::count_if(inputs, counts) != 1)
    return std::nullopt;
  const FormulaInput &counted = formulas.input(*counter);
  const auto &startNodes = counted.counter->startNodes;
  const bool isOfLoop =
      std::ranges::binary_search(loop.nodes, counted.counter->step) &&
      std::ranges::none_of(startNodes, [&](NodeId node) { return std::ranges::binary_search(loop.nodes, node); });
  if (!isOfLoop || !passesAlways(facts, loop, counted.counter->step))
    return std::nullopt;
  const auto definitions = definitionsOf(facts, counted.variable, exit.test);
  return LoopEnd{relation,
                 exit.leavesWhenTrue,
                 *left,
                 *right,
                 *counter,
                 static_cast<std::size_t>(counter - inputs.begin()) < onLeft,
                 definitions && definitions->areOnly(counted.counter->step),
                 inputs};
}

bool isEquality(const LoopEnd &end) {
  return end.relation->op == OperatorKind::Equal || end.relation->op == OperatorKind::NotEqual;
}

std::optional<Iterations> countIterations(const Formulas &formulas, const LoopEnd &end, FormulaSetting setting,
                                          std::int64_t most) {
  const FormulaInput::Counter &counter = *formulas.input(end.counter).counter;
  std::optional<RoundedNumber> &count = setting[end.counter.index()];
  count = formulas.value(counter.start, setting);
  std::optional<std::int64_t> exact;
  std::optional<std::int64_t> computed;
  std::optional<RoundedNumber> atEnd;
  ExpressionId rounded = end.relation->left;
  for (std::int64_t i = end.testsAfterStep ? 1 : 0; count && i <= most && !(exact && computed); ++i) {
    const auto left = formulas.value(end.left, setting);
    const auto right = formulas.value(end.right, setting);
    const auto truth = left && right ? formulas.truth(end.relation->op, *left, *right) : std::nullopt;
    if (!truth)
      break;
    if (!exact && truth->exact == end.leavesWhenTrue)
      exact = i;
    if (!computed && truth->computed == end.leavesWhenTrue)
      computed = i;
    if (!atEnd && (exact || computed)) {
      const bool isLeft = end.countsOnLeft ? left->isInexact() : !right->isInexact();
      atEnd = isLeft ? left : right;
      rounded = isLeft ? end.relation->left : end.relation->right;
    }
    count = formulas.stepped(counter, *count, setting);
  }
  return exact && atEnd && (computed || isEquality(end)) ? std::optional(Iterations{*exact, computed, rounded, *atEnd})
                                                         : std::nullopt;
}

} // namespace feedhold::rules
