// variable-not-available: `#50`, `#250`: between the ranges.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::variable_not_available {
namespace {

/// The nearest ranges around a number that is in none, for "the control has #1-#33 and #100-#199".
std::string neighbours(const Dialect &dialect, std::uint32_t number) {
  const VariableRange *below = nullptr;
  const VariableRange *above = nullptr;
  for (const VariableRange &range : dialect.variables) {
    if (range.last < number)
      below = &range;
    else if (!above)
      above = &range;
  }
  const auto shown = [](const VariableRange *range) {
    return range->first == range->last ? fmt::format("#{}", range->first)
                                       : fmt::format("#{}-#{}", range->first, range->last);
  };
  if (!below || !above)
    return fmt::format("the {} variables are {}", below ? "last" : "first", shown(below ? below : above));
  return fmt::format("the nearest variables are {} and {}", shown(below), shown(above));
}

void check(const VariableUse &use, const FileContext &context, const Reporter &reporter) {
  if (!use.number || findVariable(context.dialect, *use.number))
    return;
  const Span span = context.tree.expressions[use.expression].span;
  reporter.report({.message = fmt::format("{} does not have {}", context.dialect.id, context.quoted(span)),
                   .span = span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::VariableNotAvailable)),
                             neighbours(context.dialect, *use.number)}});
}

} // namespace

extern const Rule variableNotAvailable;
const Rule variableNotAvailable{.info = {"variable-not-available", Category::Variable, Severity::Error,
                                         "Reports a variable number that no machine with this control has."},
                                .hooks = {.variable = check}};

} // namespace feedhold::rules::variable_not_available
