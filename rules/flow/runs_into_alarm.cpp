// runs-into-alarm: the normal way of a program leads into a block that is there for jumps.
#include "rules/flow/flow_view.h"

#include "base/support/text.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace feedhold::rules::runs_into_alarm {
namespace {

/// A GOTO leads to the block, or to a lone sequence number before it.
bool isJumpTarget(const FlowFacts &facts, BlockId block) {
  return std::ranges::any_of(facts.file.model->jumpsOf(facts.program), [&](const Jump &jump) {
    return jump.kind == JumpKind::Goto && blockBehind(facts, jump) == block;
  });
}

/// What may stand before the block.
enum class Before : std::uint8_t { Words, WordsOrAssignment };

/// The last thing that happens before the block, when the control goes on from there into it without a decision.
std::optional<NodeId> fallsFrom(const FlowFacts &facts, NodeId alarm, Before what = Before::Words) {
  if (alarm <= facts.entry())
    return std::nullopt;
  NodeId before(alarm.index() - 1);
  while (before > facts.entry() && isLoneNumber(facts, before)) {
    alarm = before;
    before = NodeId(before.index() - 1);
  }
  const Node &node = facts.node(before);
  const bool acts = std::holds_alternative<ExecuteWords>(node.instruction) ||
                    std::holds_alternative<CallProgram>(node.instruction) ||
                    (what == Before::WordsOrAssignment && std::holds_alternative<Assign>(node.instruction));
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

void checkAlarms(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
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

/// `M00 (PART OUT OF TOLERANCE)`: what the remark tells has happened, not what the operator is to look for.
bool tellsOfFailure(std::string_view text) {
  const std::string upper = toUpper(text);
  const auto has = [&](std::string_view what) { return upper.find(what) != std::string::npos; };
  constexpr std::array kFailures = {"ERROR",     "OUT OF TOL", "ALERT",   "EXCEEDED",
                                    "EXCESSIVE", "FAILED",     "FAILURE", "BROKEN"};
  constexpr std::array kQuestions = {"CHECK FOR", "CHECK IF", "IF ", "VERIFY", "?"};
  return std::ranges::any_of(kFailures, has) && std::ranges::none_of(kQuestions, has);
}

/// The stop for the operator behind a label that conditions jump to; a remark there tells of a failure.
std::optional<BlockId> failureStop(const FileContext &context, BlockId label) {
  constexpr int kFarthest = 3; // blocks
  bool isFailure = false;
  for (int i = 0; i < kFarthest && label.index() < context.tree.blockCount(); ++i, label = label.next()) {
    for (const Comment &comment : context.tree.commentsOf(label))
      isFailure = isFailure || tellsOfFailure(context.text(comment.span));
    const Word *stop = findCode(context.tree, label, context.dialect, CodeRole::ProgramStop);
    if (stop && stop->isNumber() && stop->number().isZero())
      return isFailure ? std::optional(label) : std::nullopt;
    if (moves(context, label) || !context.tree.statementsOf(label).empty())
      return std::nullopt;
  }
  return std::nullopt;
}

void checkStops(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  std::vector<BlockId> done;
  for (const Jump &jump : context.model.jumpsOf(facts.program)) {
    if (jump.kind != JumpKind::Goto || !jump.conditional || !jump.target ||
        std::ranges::find(done, *jump.target) != done.end())
      continue;
    done.push_back(*jump.target);
    const auto stop = failureStop(context, *jump.target);
    const auto before =
        stop ? fallsFrom(facts, facts.file.cfg.nodeOf(*jump.target), Before::WordsOrAssignment) : std::nullopt;
    if (!before || isRetreat(facts, *before))
      continue;
    reporter.report({.message = "the program runs on into this stop for a failure",
                     .span = context.tree.blocks[*stop].span(),
                     .labels = {{context.tree.blocks[facts.node(*before).block].span(), "runs on into the stop"},
                                {jump.span, "jumps to it in the case of a failure"}},
                     .notes = {"the operator is told of a failure where there is none",
                               "end the program with M99 or M30 before the stop, or jump over it"}});
  }
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  checkAlarms(facts, context, reporter);
  if (!isTooLarge(facts))
    checkStops(facts, context, reporter);
}

} // namespace

extern const Rule runsIntoAlarm;
const Rule runsIntoAlarm{
    .info = {"runs-into-alarm", Category::Flow, Severity::Warning,
             "Reports an alarm, or a stop for a failure, that the program runs into without a jump."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::runs_into_alarm
