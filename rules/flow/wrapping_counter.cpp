// wrapping-counter: a counter that starts again at 1, and a loop that only `EQ` with a variable ends.
#include "rules/flow/loop_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::wrapping_counter {
namespace {

struct Wrap {
  std::uint32_t counter;
  std::uint32_t last; // the variable that ends the loop
  Span reset;
};

/// Other conditions than that of the exit ask for the variable: its range may be known.
bool isTestedElsewhere(const FlowFacts &facts, std::uint32_t variable, const LoopExit &exit) {
  const BlockId block = facts.node(exit.test).block;
  return std::ranges::any_of(readsOf(facts), [&](const Read &read) {
    return read.number == variable && read.block != block &&
           (read.use == ReadUse::Equality || read.use == ReadUse::Ordering);
  });
}

/// In the loop: one step of the counter, and one block that sets it back to a number.
std::optional<Span> resetIn(const FlowFacts &facts, const LoopFlow &loop, std::uint32_t counter) {
  const SyntaxTree &tree = *facts.file.tree;
  const auto writes = writesTo(facts, loop, counter);
  if (!writes || writes->size() != 2)
    return std::nullopt;
  std::optional<Span> reset;
  bool steps = false;
  for (const LoopWrite &write : *writes) {
    const auto step = stepOf(facts, write.assignment, counter);
    steps = steps || (step && literalValue(tree, step->size));
    if (literalValue(tree, write.assignment.value))
      reset = cover(tree.expressions[write.assignment.target].span, tree.expressions[write.assignment.value].span);
  }
  return steps ? reset : std::nullopt;
}

std::optional<Wrap> wrapOf(const FlowFacts &facts, const LoopFlow &loop) {
  if (!loop.exitsAreKnown || loop.exits.size() != 1)
    return std::nullopt;
  const LoopExit &exit = loop.exits.front();
  const auto *relation = asInside<BinaryOperation>(*facts.file.tree, exit.condition);
  if (!relation || relation->op != (exit.leavesWhenTrue ? OperatorKind::Equal : OperatorKind::NotEqual))
    return std::nullopt;
  for (const auto &[one, other] : {std::pair{relation->left, relation->right}, {relation->right, relation->left}}) {
    const auto counter = variableOf(facts, one);
    const auto last = variableOf(facts, other);
    if (!counter || !last || !isPlain(facts.file, *counter) || !isPlain(facts.file, *last))
      continue;
    const auto writes = writesTo(facts, loop, *last);
    const AbstractValue *value = facts.valueOf(unwrapped(*facts.file.tree, other));
    const bool isKnown = !value || (value->isNumber() && value->number().interval().isFinite());
    if (!writes || !writes->empty() || isKnown || isTestedElsewhere(facts, *last, exit) ||
        facts.programs.isWrittenInCalled(*last))
      continue;
    if (const auto reset = resetIn(facts, loop, *counter))
      return Wrap{*counter, *last, *reset};
  }
  return std::nullopt;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (const LoopFlow &loop : loopsOf(facts)) {
    const auto wrap = wrapOf(facts, loop);
    if (!wrap)
      continue;
    const Span condition = context.tree.expressions[loop.exits.front().condition].span;
    reporter.report(
        {.message = fmt::format("only {} ends this loop, and `#{}` starts again at a fixed value: the two may never "
                                "be equal",
                                context.quoted(condition), wrap->counter),
         .span = condition,
         .labels = {{wrap->reset, "starts again"}},
         .flow = pathFromEntry(facts, loop.exits.front().test),
         .notes = {fmt::format("if `#{}` is vacant, beyond the last value or no whole number, the loop never ends",
                               wrap->last),
                   fmt::format("check the range of `#{}` before the loop", wrap->last)}});
  }
}

} // namespace

extern const Rule wrappingCounter;
const Rule wrappingCounter{
    .info = {"wrapping-counter", Category::Flow, Severity::Warning,
             "Reports a loop that ends by `EQ` with a variable while its counter starts again at a fixed value."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::wrapping_counter
