// read-of-write-only: `#1=#3000`.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules {
namespace {

void check(const VariableUse &use, const FileContext &context, const Reporter &reporter) {
  const VariableRange *range = !use.write && use.number ? findVariable(context.dialect, *use.number) : nullptr;
  if (!range || range->access != VariableAccess::WriteOnly)
    return;
  const Span span = context.tree.expressions[use.expression].span;
  reporter.report({.message = fmt::format("{} can only be set", context.quoted(span)),
                   .span = span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::ReadProtected))}});
}

} // namespace

extern const Rule readOfWriteOnly;
const Rule readOfWriteOnly{
    .info = {"read-of-write-only", Category::Variable, Severity::Error,
             "Reports the reading of a system variable that can only be set, as the alarm number."},
    .hooks = {.variable = check}};

} // namespace feedhold::rules
