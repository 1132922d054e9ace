// offset-of-other-axis: `#5221=#5062`.
#include "rules/expressions/expression_view.h"
#include "rules/flow/system_variables.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace feedhold::rules::offset_of_other_axis {
namespace {

/// In the order of the numbers.
std::string_view axesOf(const FileContext &context) {
  return context.dialect.machine == MachineKind::Turning ? "XZ" : "XYZ";
}

/// Of a position or a work offset: 0 for X. Tables of both have 20 numbers for each row.
std::optional<std::uint32_t> axisOf(const FileContext &context, ExpressionId id) {
  const auto number = variableNumber(context.tree, unwrapped(context.tree, id));
  if (!number)
    return std::nullopt;
  const VariableRole role = roleOf(context, *number);
  constexpr std::uint32_t kRow = 20;
  const std::uint32_t axis = (*number - 1) % kRow;
  return (isPosition(role) || role == VariableRole::WorkOffset) && axis < axesOf(context).size() ? std::optional(axis)
                                                                                                 : std::nullopt;
}

struct Mixed {
  std::uint32_t own;
  std::uint32_t other;
  Span place;
};

/// Terms of other axes, and none of its own.
std::optional<Mixed> mixedIn(const Statement &statement, const FileContext &context) {
  const auto *assignment = std::get_if<Assignment>(&statement.node);
  const auto target = assignment ? variableNumber(context.tree, assignment->target) : std::nullopt;
  if (!target || roleOf(context, *target) != VariableRole::WorkOffset)
    return std::nullopt;
  const auto own = axisOf(context, assignment->target);
  std::optional<Mixed> mixed;
  for (const SumTerm &term : termsOf(context.tree, assignment->value)) {
    const auto axis = axisOf(context, term.value);
    if (axis == own)
      return std::nullopt;
    if (own && axis && !mixed)
      mixed = Mixed{*own, *axis, context.tree.expressions[term.value].span};
  }
  return mixed;
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  const std::string_view axes = axesOf(context);
  std::vector<Mixed> found;
  const Program &whole = context.model.programs[program];
  for (BlockId block = whole.first; block < whole.last; block = block.next())
    for (const Statement &statement : context.tree.statementsOf(block))
      if (const auto mixed = mixedIn(statement, context))
        found.push_back(*mixed);
  for (const Mixed &mixed : found) {
    // X from Y and Y from X: the part is turned.
    if (std::ranges::any_of(found, [&](const Mixed &each) { return each.own == mixed.other; }))
      continue;
    reporter.report(
        {.message = fmt::format("the work offset of {} takes a coordinate of {}", axes[mixed.own], axes[mixed.other]),
         .span = mixed.place,
         .notes = {axes == "XZ" ? "the numbers of the tables follow the axes: the last digit 1 is X, 2 is Z"
                                : "the numbers of the tables follow the axes: the last digit 1 is X, 2 is Y, 3 is Z",
                   fmt::format("take the variable of {}", axes[mixed.own])}});
  }
}

} // namespace

extern const Rule offsetOfOtherAxis;
const Rule offsetOfOtherAxis{.info = {"offset-of-other-axis", Category::Motion, Severity::Warning,
                                      "Reports a work offset that is set to the position or the offset of another "
                                      "axis."},
                             .hooks = {.program = check}};

} // namespace feedhold::rules::offset_of_other_axis
