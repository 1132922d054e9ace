// position-read-in-motion: #5021 or #5041 right behind a movement.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::position_read_in_motion {
namespace {

constexpr std::size_t kMostBlocksBack = 8;

bool isPosition(const VariableUse &use, const FileContext &context) {
  if (use.write || !use.number)
    return false;
  const VariableRange *range = findVariable(context.dialect, *use.number);
  return range && (range->role == VariableRole::MachinePosition || range->role == VariableRole::WorkPosition);
}

/// The control does not read ahead over an M code, a dwell, a skip, a move in machine coordinates, a called program.
bool stopsReadingAhead(const MotionView &view, NodeId node) {
  if (std::holds_alternative<CallProgram>(view.node(node).instruction))
    return true;
  return std::ranges::any_of(view.wordsOf(node), [&](const Word *word) {
    if (word->address() == 'M')
      return true;
    const Code *code = word->address() == 'G' ? codeOf(*word, view.context().dialect) : nullptr;
    return word->address() == 'G' &&
           (!code || code->role == CodeRole::Dwell || isSkip(code->role) || code->role == CodeRole::MachinePosition ||
            code->role == CodeRole::ReferenceReturn || code->action == CodeAction::CompensationOff);
  });
}

/// The movement that is still under way: straight back from the read, with nothing between that waits for it.
std::optional<NodeId> movementBefore(const MotionView &view, const FlowFacts &facts, NodeId read) {
  NodeId node = read;
  for (std::size_t steps = 0; steps < kMostBlocksBack && node != facts.entry(); ++steps) {
    const NodeId before(node.index() - 1);
    if (!facts.isReached(before) || view.node(before).next != node || stopsReadingAhead(view, before))
      return std::nullopt;
    if (!view.modalMotionWords(before).empty())
      return before;
    node = before;
  }
  return std::nullopt;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  // LinuxCNC: the variables hold the programmed position of the interpreter, and no axis is asked.
  if (context.dialect.grammar.oWords)
    return;
  const MotionView view(facts.program, context);
  std::optional<BlockId> told;
  for (const VariableUse &use : context.model.variablesOf(facts.program)) {
    if (!isPosition(use, context) || told == use.block)
      continue;
    const auto node = reachedNode(facts, use.block);
    const auto movement = node ? movementBefore(view, facts, *node) : std::nullopt;
    if (!movement)
      continue;
    told = use.block;
    const Span place = context.tree.expressions[use.expression].span;
    reporter.report({.message = fmt::format("{} is read while the axes may still be moving", context.quoted(place)),
                     .span = place,
                     .labels = {{view.blockSpan(*movement), "this move may not have finished"}},
                     .notes = {"a control that reads ahead returns some position along the move",
                               "read the end point (#5001 and up), or make the control wait first: a dwell, or an M "
                               "code that stops the look-ahead"}});
  }
}

} // namespace

extern const Rule positionReadInMotion;
const Rule positionReadInMotion{.info = {"position-read-in-motion", Category::Motion, Severity::Info,
                                         "Reports a current position that is read right after a move, with nothing in "
                                         "between that makes the control wait."},
                                .hooks = {.flow = check}};

} // namespace feedhold::rules::position_read_in_motion
