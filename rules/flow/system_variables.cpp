#include "rules/flow/system_variables.h"

namespace feedhold::rules {
namespace {

const VariableRange *systemRange(const FileContext &context, std::uint32_t variable) {
  const VariableRange *range = variable >= kFirstNamedVariable ? nullptr : findVariable(context.dialect, variable);
  return range && range->kind == VariableKind::System ? range : nullptr;
}

} // namespace

VariableRole roleOf(const FileContext &context, std::uint32_t variable) {
  const VariableRange *range = systemRange(context, variable);
  return range ? range->role : VariableRole::Plain;
}

bool isToolOffset(const FileContext &context, std::uint32_t variable) {
  const VariableRange *range = systemRange(context, variable);
  return range && range->role == VariableRole::Stored &&
         (range->meaning.starts_with("tool ") || range->meaning.starts_with("geometry") ||
          range->meaning.starts_with("wear"));
}

bool isOffset(const FileContext &context, std::uint32_t variable) {
  const VariableRole role = roleOf(context, variable);
  return role == VariableRole::WorkOffset || role == VariableRole::AdditionalWorkOffset ||
         isToolOffset(context, variable);
}

bool isPosition(VariableRole role) {
  return role == VariableRole::SkipPosition || role == VariableRole::BlockEndPosition ||
         role == VariableRole::MachinePosition || role == VariableRole::WorkPosition;
}

std::optional<std::uint32_t> tableNumber(const FileContext &context, ExpressionId variable) {
  const ExpressionId inner = unwrapped(context.tree, variable);
  if (const auto number = variableNumber(context.tree, inner))
    return number;
  const auto *indirect = as<IndirectVariable>(context.tree, inner);
  if (!indirect)
    return std::nullopt;
  for (const ExpressionId part : subexpressions(context.tree, indirect->index)) {
    const auto base = literalValue(context.tree, part);
    if (!base || !base->isInteger() || *base < Decimal(1000, 0) || *base > Decimal(1'000'000, 0))
      continue;
    const auto number = static_cast<std::uint32_t>(base->toDouble());
    return systemRange(context, number) && number % 100 != 0 ? number : number + 1; // `#[2000+#3]` begins at #2001
  }
  return std::nullopt;
}

} // namespace feedhold::rules
