// skip-check-of-other-axis: `G31 Z-10. F100`, and then `IF[#5061EQ#5041]`: X has not moved.
#include "rules/flow/system_variables.h"
#include "rules/motion/touch_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::skip_check_of_other_axis {
namespace {

/// The axis of `#5061` or `#5041`.
std::optional<char> axisOf(const FileContext &context, ExpressionId id, bool ofSkip) {
  const auto number = variableNumber(context.tree, unwrapped(context.tree, id));
  return number && (roleOf(context, *number) == VariableRole::SkipPosition) == ofSkip ? axisOfPosition(context, *number)
                                                                                      : std::nullopt;
}

/// The axis of a comparison of the skip position with where the axis is, or was to go.
std::optional<char> comparedIn(const FileContext &context, ExpressionId condition) {
  const auto *relation = asInside<BinaryOperation>(context.tree, condition);
  if (!relation || (relation->op != OperatorKind::Equal && relation->op != OperatorKind::NotEqual))
    return std::nullopt;
  for (const auto &[skip, other] :
       {std::pair{relation->left, relation->right}, std::pair{relation->right, relation->left}})
    if (const auto axis = axisOf(context, skip, true); axis && axisOf(context, other, false) == axis)
      return axis;
  return std::nullopt;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts) || context.dialect.machine == MachineKind::Turning)
    return;
  const MotionView view(facts.program, context);
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    const auto axis =
        test && test->condition && facts.isReached(node) ? comparedIn(context, *test->condition) : std::nullopt;
    const auto skip = axis ? skipBefore(facts, view, node) : std::nullopt;
    if (!skip)
      continue;
    const auto words = view.axisWords(*skip);
    const auto names = [&](const Word *word) { return word->address() == *axis; };
    if (words.empty() || std::ranges::any_of(words, names))
      continue;
    const Span condition = context.tree.expressions[*test->condition].span;
    reporter.report(
        {.message = fmt::format("{} asks of {}, which the skip move does not move", context.quoted(condition), *axis),
         .span = condition,
         .labels = {{view.blockSpan(*skip), fmt::format("moves {} only", words.front()->address())}},
         .notes = {fmt::format("both positions of {} are always the same: whether the probe has touched is "
                               "not checked",
                               *axis),
                   fmt::format("compare the positions of {}", words.front()->address())}});
  }
}

} // namespace

extern const Rule skipCheckOfOtherAxis;
const Rule skipCheckOfOtherAxis{
    .info = {"skip-check-of-other-axis", Category::Motion, Severity::Warning,
             "Reports a check behind a skip move that compares the positions of an axis that "
             "has not moved."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::skip_check_of_other_axis
