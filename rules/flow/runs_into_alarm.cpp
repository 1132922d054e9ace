// runs-into-alarm: the normal way of a program leads into a block that is there for jumps.
#include "rules/flow/flow_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules {
namespace {

bool isJumpTarget(const FileContext &context, ProgramId program, BlockId block) {
  return std::ranges::any_of(context.model.jumpsOf(program),
                             [&](const Jump &jump) { return jump.kind == JumpKind::Goto && jump.target == block; });
}

/// The last thing that happens before the block, when the control goes on from there into it without a decision.
std::optional<NodeId> fallsFrom(const FlowFacts &facts, NodeId alarm) {
  if (alarm <= facts.entry())
    return std::nullopt;
  const NodeId before(alarm.index() - 1);
  const Node &node = facts.node(before);
  const bool acts =
      std::holds_alternative<ExecuteWords>(node.instruction) || std::holds_alternative<CallProgram>(node.instruction);
  return node.next == alarm && facts.isReached(before) && acts ? std::optional(before) : std::nullopt;
}

/// Axes move in the block: that is work, not the preparation of an alarm.
bool moves(const FileContext &context, BlockId block) {
  return std::ranges::any_of(context.tree.wordsOf(block), [](const Word &word) {
    return word.address() == 'X' || word.address() == 'Y' || word.address() == 'Z';
  });
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (const UserAlarmFact &alarm : facts.userAlarms()) {
    const BlockId block = facts.node(alarm.node).block;
    const auto before = fallsFrom(facts, alarm.node);
    if (!before || !isJumpTarget(context, facts.program, block))
      continue;
    const BlockId last = facts.node(*before).block;
    const bool isCall = std::holds_alternative<CallProgram>(facts.node(*before).instruction);
    if (!isCall && !moves(context, last))
      continue;
    reporter.report({.message = "the program runs into this alarm at its end",
                     .span = alarm.place,
                     .labels = {{context.tree.blocks[last].span(), "goes on into the alarm"}},
                     .way = wayFromEntry(facts, alarm.node),
                     .notes = {"end the program before the alarms with M99 or M30, or jump over them"}});
  }
}

} // namespace

extern const Rule runsIntoAlarm;
const Rule runsIntoAlarm{.info = {"runs-into-alarm", Category::Flow, Severity::Warning,
                                  "Reports an alarm block that the program runs into without a jump."},
                         .hooks = {.flow = check}};

} // namespace feedhold::rules
