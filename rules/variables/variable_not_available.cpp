// variable-not-available: `#50`, `#250`: between the ranges.
#include "findings/rule/rule.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace feedhold::rules::variable_not_available {
namespace {

constexpr std::size_t kForeignVariables = 4;

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

using Uses = std::map<std::uint32_t, Span>; // of variables that the control does not have, where first

Uses usesOf(const FileContext &context) {
  Uses uses;
  for (const VariableUse &use : context.model.variables)
    if (use.number && !findVariable(context.dialect, *use.number))
      uses.emplace(*use.number, context.tree.expressions[use.expression].span);
  return uses;
}

/// One slip names one variable; a program for another control, or for the options of a machine, names many.
void reportAll(const Uses &uses, const FileContext &context, const Reporter &reporter) {
  const auto first = std::ranges::min_element(uses, {}, [](const auto &use) { return use.second.begin; });
  reporter.report({.message = fmt::format("{} and {} more variables do not exist on {}", context.quoted(first->second),
                                          uses.size() - 1, context.dialect.id),
                   .span = first->second,
                   .notes = {"the program may be for another control: choose it with `dialect` in feedhold.toml",
                             "variables of the machine builder are listed under `builders-variables` there"}},
                  Severity::Warning);
}

void check(const FileContext &context, const Reporter &reporter) {
  if (const Uses uses = usesOf(context); uses.size() >= kForeignVariables)
    return reportAll(uses, context, reporter);
  for (const VariableUse &use : context.model.variables) {
    if (!use.number || findVariable(context.dialect, *use.number))
      continue;
    const Span span = context.tree.expressions[use.expression].span;
    reporter.report(
        {.message = fmt::format("{} does not have {}", context.dialect.id, context.quoted(span)),
         .span = span,
         .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::VariableNotAvailable)),
                   neighbours(context.dialect, *use.number)}});
  }
}

} // namespace

extern const Rule variableNotAvailable;
const Rule variableNotAvailable{.info = {"variable-not-available", Category::Variable, Severity::Error,
                                         "Reports a variable number that no machine with this control has."},
                                .hooks = {.file = check}};

} // namespace feedhold::rules::variable_not_available
