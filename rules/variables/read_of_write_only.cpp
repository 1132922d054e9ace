// read-of-write-only: `#1=#3000`.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::read_of_write_only {
namespace {

void check(const VariableUse &use, const FileContext &context, const Reporter &reporter) {
  const VariableRange *range = !use.write && use.number ? findVariable(context.dialect, *use.number) : nullptr;
  if (!range || range->access != VariableAccess::WriteOnly)
    return;
  const Span span = context.tree.expressions[use.expression].span;
  reporter.report({.message = fmt::format("{} can only be written, not read", context.quoted(span)),
                   .span = span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::ReadProtected))}});
}

} // namespace

extern const Rule readOfWriteOnly;
const Rule readOfWriteOnly{
    .info = {"read-of-write-only", Category::Variable, Severity::Error,
             "Reports a read of a system variable that can only be written, such as the alarm number."},
    .hooks = {.variable = check}};

} // namespace feedhold::rules::read_of_write_only
