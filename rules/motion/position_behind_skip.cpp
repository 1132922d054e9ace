// position-behind-skip: `G31Z-30.F200.`, then `#100=#5043`.
#include "rules/flow/system_variables.h"
#include "rules/motion/motion_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::position_behind_skip {
namespace {

constexpr std::size_t kMostBlocksBack = 8;

bool hasRole(const VariableUse &use, const FileContext &context, std::initializer_list<VariableRole> roles) {
  const VariableRange *range = use.write || !use.number ? nullptr : findVariable(context.dialect, *use.number);
  return range && std::ranges::find(roles, range->role) != roles.end();
}

bool isSkipMove(const MotionView &view, NodeId node) {
  return view.findAction(node, {CodeAction::Skip}) != nullptr && !view.axisWords(node).empty();
}

/// The skip move straight before the read.
std::optional<NodeId> skipBefore(const MotionView &view, const FlowFacts &facts, NodeId read) {
  NodeId node = read;
  for (std::size_t steps = 0; steps < kMostBlocksBack && node != facts.entry(); ++steps) {
    const NodeId before(node.index() - 1);
    if (!facts.isReached(before) || view.node(before).next != node ||
        std::holds_alternative<CallProgram>(view.node(before).instruction))
      return std::nullopt;
    if (isSkipMove(view, before))
      return before;
    if (!view.axisWords(before).empty())
      return std::nullopt;
    node = before;
  }
  return std::nullopt;
}

/// The value goes to an offset of a tool or of the part.
bool isMeasurement(const FlowFacts &facts, const FileContext &context, NodeId node) {
  return std::ranges::any_of(assignmentsOf(facts, node), [&](const Assignment &assignment) {
    const auto target = tableNumber(context, assignment.target);
    return target && isOffset(context, *target);
  });
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.grammar.oWords)
    return;
  const auto uses = context.model.variablesOf(facts.program);
  if (std::ranges::any_of(uses,
                          [&](const VariableUse &use) { return hasRole(use, context, {VariableRole::SkipPosition}); }))
    return;
  const MotionView view(facts.program, context);
  for (const VariableUse &use : uses) {
    if (!hasRole(use, context, {VariableRole::MachinePosition, VariableRole::WorkPosition}))
      continue;
    const auto node = reachedNode(facts, use.block);
    const auto skip = node ? skipBefore(view, facts, *node) : std::nullopt;
    if (!skip)
      continue;
    const Span place = context.tree.expressions[use.expression].span;
    reporter.report(
        {.message = fmt::format("{} is where the axis stopped, not where the probe touched", context.quoted(place)),
         .span = place,
         .labels = {{view.blockSpan(*skip), "the skip move"}},
         .notes = {"from the signal to the stop the axis runs on, the farther the faster it is fed",
                   "read the skip position, `#5061` and up"}},
        isMeasurement(facts, context, *node) ? Severity::Warning : Severity::Info);
    return;
  }
}

} // namespace

extern const Rule positionBehindSkip;
const Rule positionBehindSkip{.info = {"position-behind-skip", Category::Motion, Severity::Warning,
                                       "Reports a current position that is read behind a skip move, in a program that "
                                       "never reads the skip position."},
                              .hooks = {.flow = check}};

} // namespace feedhold::rules::position_behind_skip
