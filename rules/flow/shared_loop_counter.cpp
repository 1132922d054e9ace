// shared-loop-counter: the loop inside counts with the variable of the loop around it.
#include "rules/flow/loop_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::shared_loop_counter {
namespace {

std::optional<std::uint32_t> counterOf(const FlowFacts &facts, const Loop &loop) {
  const SyntaxTree &tree = *facts.file.tree;
  for (const Statement &statement : tree.statementsOf(loop.doBlock)) {
    const auto *condition = std::get_if<While>(&statement.node);
    const auto *relation =
        condition && condition->condition ? asInside<BinaryOperation>(tree, *condition->condition) : nullptr;
    const auto variable = relation ? variableNumber(tree, unwrapped(tree, relation->left)) : std::nullopt;
    if (variable && isPlain(facts.file, *variable))
      return variable;
  }
  return std::nullopt;
}

/// `#1=#1-1` in the blocks of `outer`, not in those of `inner`; and in those of `inner` when that is asked.
std::optional<Span> stepIn(const FlowFacts &facts, BlockId first, BlockId last, std::uint32_t variable) {
  const SyntaxTree &tree = *facts.file.tree;
  for (BlockId block = first; block < last; block = block.next())
    for (const Statement &statement : tree.statementsOf(block))
      if (const auto *assignment = std::get_if<Assignment>(&statement.node);
          assignment && variableNumber(tree, unwrapped(tree, assignment->target)) == variable &&
          stepOf(facts, *assignment, variable))
        return statement.span;
  return std::nullopt;
}

void checkPair(const Loop &outer, const Loop &inner, const FlowFacts &facts, const FileContext &context,
               const Reporter &reporter) {
  const auto counter = counterOf(facts, outer);
  const auto innerStep = counter ? stepIn(facts, inner.doBlock, *inner.endBlock, *counter) : std::nullopt;
  if (!innerStep)
    return;
  auto outerStep = stepIn(facts, outer.doBlock.next(), inner.doBlock, *counter);
  if (!outerStep)
    outerStep = stepIn(facts, inner.endBlock->next(), *outer.endBlock, *counter);
  if (!outerStep)
    return;
  reporter.report(
      {.message = fmt::format("`#{}` is the counter of the outer loop, but the inner loop changes it too", *counter),
       .span = *innerStep,
       .labels = {{*outerStep, "the step of the outer loop"},
                  {context.tree.statements[inner.doStatement].span, "the inner loop"}},
       .notes = {"the outer loop skips iterations; give the inner loop its own counter"}});
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  const auto loops = context.model.loopsOf(facts.program);
  for (const Loop &inner : loops) {
    if (!inner.endBlock)
      continue;
    for (const Loop &outer : loops)
      if (outer.endBlock && outer.doBlock < inner.doBlock && *inner.endBlock < *outer.endBlock &&
          counterOf(facts, inner) != counterOf(facts, outer))
        checkPair(outer, inner, facts, context, reporter);
  }
}

} // namespace

extern const Rule sharedLoopCounter;
const Rule sharedLoopCounter{.info = {"shared-loop-counter", Category::Flow, Severity::Warning,
                                      "Reports an inner loop that changes the counter of the outer loop."},
                             .hooks = {.flow = check}};

} // namespace feedhold::rules::shared_loop_counter
