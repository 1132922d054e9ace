// alarm-never-fires: `#3000=` in a block that jumps name, and that no run reaches.
#include "rules/flow/loop_view.h"
#include "rules/structure/structure_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::alarm_never_fires {
namespace {

/// A jump to the block whose condition has its outcome for other reasons than a wrong check.
bool isReserve(const FlowFacts &facts, const Jump &jump) {
  const auto statements = facts.file.tree->statementsOf(jump.block);
  return std::ranges::any_of(statements, [&](const Statement &statement) {
    const auto condition = conditionOf(statement);
    return condition && isAskedToBeSure(facts, *condition, jump.block);
  });
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!context.model.programs[facts.program].returns)
    return; // settings at its head decide what is left out
  const DeadBlocks dead(context, facts.program);
  for (const VariableUse &use : context.model.variablesOf(facts.program)) {
    // A block to which not even the text leads is another rule's.
    if (!use.write || !use.number || !raisesAlarm(context.dialect, *use.number) || dead.contains(use.block) ||
        reachedNode(facts, use.block))
      continue;
    const auto all = context.model.jumpsOf(facts.program);
    if (std::ranges::any_of(
            all, [&](const Jump &jump) { return blockBehind(facts, jump) == use.block && isReserve(facts, jump); }))
      continue;
    const Span span = context.tree.expressions[use.expression].span;
    std::vector<Label> jumps;
    for (const Jump &jump : all)
      if (blockBehind(facts, jump) == use.block)
        jumps.push_back({jump.span, "this jump is never taken"});
    reporter.report(
        {.message = "this alarm is never raised: no path reaches it",
         .span = span,
         .labels = std::move(jumps),
         .notes = {"the conditions before it always have the same outcome; check their comparisons and variables"}});
  }
}

} // namespace

extern const Rule alarmNeverFires;
const Rule alarmNeverFires{
    .info = {"alarm-never-fires", Category::Flow, Severity::Info,
             "Reports an alarm that is never raised, because the conditions before it rule it out."},
    .hooks = {.flow = check, .flowRuns = FlowRuns::All}};

} // namespace feedhold::rules::alarm_never_fires
