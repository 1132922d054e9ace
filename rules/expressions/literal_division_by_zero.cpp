// literal-division-by-zero: `#1/0`.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include <fmt/format.h>

namespace feedhold::rules::literal_division_by_zero {
namespace {

void check(ExpressionId id, BlockId, const FileContext &context, const Reporter &reporter) {
  const auto *operation = as<BinaryOperation>(context.tree, id);
  if (!operation || (operation->op != OperatorKind::Divide && operation->op != OperatorKind::Modulo))
    return;
  const auto divisor = literalValue(context.tree, operation->right);
  if (!divisor || !divisor->isZero())
    return;
  const Span span = context.tree.expressions[id].span;
  reporter.report({.message = fmt::format("{} divides by zero", context.quoted(span)),
                   .span = context.tree.expressions[operation->right].span,
                   .labels = {{operation->opSpan, ""}},
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::DivideByZero))}});
}

} // namespace

extern const Rule literalDivisionByZero;
const Rule literalDivisionByZero{.info = {"literal-division-by-zero", Category::Expression, Severity::Error,
                                          "Reports a division, or a `MOD`, by the number 0."},
                                 .hooks = {.expression = check, .expressionNodes = nodeSet<BinaryOperation>()}};

} // namespace feedhold::rules::literal_division_by_zero
