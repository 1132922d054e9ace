// control-switch-left-on: #3003 or #3004 not 0 at the end.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::control_switch_left_on {
namespace {

struct ControlSwitch {
  std::uint32_t variable;
  std::string_view locks;
};
// Source: macro variables of the operator's manuals; bits switch off single block, waiting for completion, feed hold,
// override, exact stop.
constexpr std::array kControlSwitches = {ControlSwitch{3003, "single block or the wait for auxiliary functions"},
                                         ControlSwitch{3004, "feed hold, feed override or exact stop"}};

/// Some path leaves a value other than 0 there, and the value is known: it is none that was saved at the head.
bool isLeftOn(const ExitFact &exit, std::uint32_t variable) {
  const AbstractValue *value = exit.state.variables.find(variable);
  if (exit.end == PathEnd::Alarm || !value || isHavocked(exit.state) || !value->mayBeNumber() || value->mayBeVacant())
    return false;
  const auto constant = value->number().constantValue();
  if (constant)
    return *constant != 0;
  const bool isSaved =
      value->origin() && value->origin()->symbol != kZeroSymbol && isEntrySymbol(value->origin()->symbol);
  return !isSaved && value->number().interval().isFinite() && !value->number().interval().isConstant();
}

bool writesZero(const VariableUse &use, const FileContext &context) {
  for (const Statement &statement : context.tree.statementsOf(use.block))
    if (const auto *assignment = std::get_if<Assignment>(&statement.node);
        assignment && assignment->target == use.expression) {
      const auto value = literalValue(context.tree, assignment->value);
      return value && value->isZero();
    }
  return false;
}

/// The write from which the end is reached without another one.
const VariableUse *writeBefore(const ExitFact &exit, std::uint32_t variable, const FlowFacts &facts,
                               const FileContext &context) {
  const auto uses = context.model.variablesOf(facts.program);
  const auto writes = [&](NodeId node) {
    return std::ranges::any_of(uses, [&](const VariableUse &use) {
      return use.write && use.number == variable && use.block == facts.node(node).block;
    });
  };
  for (const VariableUse &use : uses) {
    if (!use.write || use.number != variable)
      continue;
    const auto node = reachedNode(facts, use.block);
    if (node && findPath(facts, *node, exit.node, writes) && !writesZero(use, context))
      return &use;
  }
  return nullptr;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (const ControlSwitch &which : kControlSwitches) {
    const VariableRange *range = findVariable(context.dialect, which.variable);
    if (!range || range->kind != VariableKind::System)
      continue;
    for (const ExitFact &exit : facts.exits()) {
      if (!isLeftOn(exit, which.variable) || isOfLocalCall(exit, facts))
        continue;
      const VariableUse *use = writeBefore(exit, which.variable, facts, context);
      if (!use)
        continue;
      const MotionView view(facts.program, context);
      const Span place = context.tree.expressions[use->expression].span;
      reporter.report({.message = fmt::format("`#{}` is not reset to 0 on every path to the end", which.variable),
                       .span = place,
                       .labels = {{view.blockSpan(exit.node), "ends here"}},
                       .flow = pathFromEntry(facts, exit.node),
                       .notes = {fmt::format("{} stays disabled for everything that runs afterwards", which.locks),
                                 fmt::format("write `#{}=0` before every end of the program", which.variable)}});
      break;
    }
  }
}

} // namespace

extern const Rule controlSwitchLeftOn;
const Rule controlSwitchLeftOn{.info = {"control-switch-left-on", Category::Motion, Severity::Warning,
                                        "Reports a program that disables single block, feed hold or override with "
                                        "`#3003` or `#3004` and does not reset it on some path."},
                               .hooks = {.flow = check}};

} // namespace feedhold::rules::control_switch_left_on
