// write-to-vacant: `#0=5`.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::write_to_vacant {
namespace {

void check(const VariableUse &use, const FileContext &context, const Reporter &reporter) {
  const VariableRange *range = use.write && use.number ? findVariable(context.dialect, *use.number) : nullptr;
  if (!range || range->kind != VariableKind::Vacant)
    return;
  const Span span = context.tree.expressions[use.expression].span;
  reporter.report({.message = fmt::format("{} is always vacant and cannot be written", context.quoted(span)),
                   .span = span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WriteProtected)),
                             "to clear a variable, write it the other way round: `#1=#0`"}});
}

} // namespace

extern const Rule writeToVacant;
const Rule writeToVacant{.info = {"write-to-vacant", Category::Variable, Severity::Error,
                                  "Reports an assignment to `#0`, which is always vacant."},
                         .hooks = {.variable = check}};

} // namespace feedhold::rules::write_to_vacant
