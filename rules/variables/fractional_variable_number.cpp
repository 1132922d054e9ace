// fractional-variable-number: `#100.5`.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::fractional_variable_number {
namespace {

void check(ExpressionId id, BlockId, const FileContext &context, const Reporter &reporter) {
  const auto *variable = std::get_if<NumberedVariable>(&context.tree.expressions[id].node);
  if (!variable || context.dialect.grammar.fractionalVariable || variable->number.isInteger())
    return;
  const Span span = context.tree.expressions[id].span;
  reporter.report({.message = fmt::format("{} is not a variable: its number must be whole", context.quoted(span)),
                   .span = span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::VariableNotAvailable)),
                             "an operator may be missing between the variable and the number after it"}});
}

} // namespace

extern const Rule fractionalVariableNumber;
const Rule fractionalVariableNumber{.info = {"fractional-variable-number", Category::Variable, Severity::Error,
                                             "Reports a variable number with a fraction."},
                                    .hooks = {.expression = check, .expressionNodes = nodeSet<NumberedVariable>()}};

} // namespace feedhold::rules::fractional_variable_number
