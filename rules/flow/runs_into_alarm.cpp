// runs-into-alarm: the normal way of a program leads into a block that is there for jumps.
#include "rules/flow/flow_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::runs_into_alarm {
namespace {

/// A GOTO leads to the block, or to a lone sequence number before it.
bool isJumpTarget(const FlowFacts &facts, BlockId block) {
  return std::ranges::any_of(facts.file.model->jumpsOf(facts.program), [&](const Jump &jump) {
    return jump.kind == JumpKind::Goto && blockBehind(facts, jump) == block;
  });
}

/// The last thing that happens before the block, when the control goes on from there into it without a decision.
std::optional<NodeId> fallsFrom(const FlowFacts &facts, NodeId alarm) {
  if (alarm <= facts.entry())
    return std::nullopt;
  NodeId before(alarm.index() - 1);
  while (before > facts.entry() && isLoneNumber(facts, before)) {
    alarm = before;
    before = NodeId(before.index() - 1);
  }
  const Node &node = facts.node(before);
  const bool acts =
      std::holds_alternative<ExecuteWords>(node.instruction) || std::holds_alternative<CallProgram>(node.instruction);
  return node.next == alarm && facts.isReached(before) && acts ? std::optional(before) : std::nullopt;
}

/// The blocks in front of the alarm, back to the last decision or end, are there for jumps as well: a retreat that ends
/// with the alarm.
bool isRetreat(const FlowFacts &facts, NodeId last) {
  for (NodeId node = last; node > facts.entry(); node = NodeId(node.index() - 1)) {
    if (isJumpTarget(facts, facts.node(node).block))
      return true;
    const NodeId before(node.index() - 1);
    if (facts.node(before).next != node || std::holds_alternative<Test>(facts.node(before).instruction))
      return false;
  }
  return false;
}

/// Axes move in the block: that is work, not the preparation of an alarm.
bool moves(const FileContext &context, BlockId block) {
  return std::ranges::any_of(context.tree.wordsOf(block), [](const Word &word) {
    return word.address() == 'X' || word.address() == 'Y' || word.address() == 'Z';
  });
}

/// A call that surely comes back: the program is in the run, and has no M30.
bool comesBack(const FlowFacts &facts, const CallProgram &call) {
  const auto callee = facts.programs.callee(facts.file.file, call.call);
  if (!callee)
    return false;
  const ProgramFile &file = facts.programs.file(callee->file);
  for (const BlockId block : blocksOf(file, callee->program)) {
    const NodeId node = file.cfg.nodeOf(block);
    const auto *end = std::get_if<EndProgram>(&file.cfg.nodes[node].instruction);
    if (end && end->end != ProgramEnd::EndOfFile && file.cfg.nodes[node].block == block)
      return false;
  }
  return true;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (const UserAlarmFact &alarm : facts.userAlarms()) {
    const BlockId block = facts.node(alarm.node).block;
    const auto before = fallsFrom(facts, alarm.node);
    if (!before || !isJumpTarget(facts, block))
      continue;
    const BlockId last = facts.node(*before).block;
    const auto *call = std::get_if<CallProgram>(&facts.node(*before).instruction);
    const bool isCall = call && comesBack(facts, *call);
    if ((!isCall && !moves(context, last)) || isRetreat(facts, *before))
      continue;
    reporter.report({.message = "the program runs on into this alarm at its end",
                     .span = alarm.place,
                     .labels = {{context.tree.blocks[last].span(), "runs on into the alarm"}},
                     .flow = pathFromEntry(facts, alarm.node),
                     .notes = {"end the program with M99 or M30 before the alarms, or jump over them"}});
  }
}

} // namespace

extern const Rule runsIntoAlarm;
const Rule runsIntoAlarm{.info = {"runs-into-alarm", Category::Flow, Severity::Warning,
                                  "Reports an alarm block that the program runs into without a jump."},
                         .hooks = {.flow = check}};

} // namespace feedhold::rules::runs_into_alarm
