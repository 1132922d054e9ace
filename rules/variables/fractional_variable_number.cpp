// fractional-variable-number: `#100.5`, `#24.`.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::fractional_variable_number {
namespace {

/// `X#24.`: the point of `X24.` was kept, or an operator and the number behind it are missing.
void reportPoint(Span span, const FileContext &context, const Reporter &reporter) {
  const std::size_t point = context.text(span).find('.');
  if (point == std::string_view::npos)
    return;
  const auto at = span.begin + static_cast<std::uint32_t>(point);
  reporter.report({.message = fmt::format("{} is not a variable: its number has a decimal point", context.quoted(span)),
                   .span = span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WordFormat)),
                             "variable numbers are written without a point"},
                   .fixes = {{.title = "remove the point", .edits = {{{at, span.end}, ""}}}}});
}

void check(ExpressionId id, BlockId, const FileContext &context, const Reporter &reporter) {
  const auto *variable = std::get_if<NumberedVariable>(&context.tree.expressions[id].node);
  const Grammar &grammar = context.dialect.grammar;
  if (!variable || grammar.fractionalVariable)
    return;
  const Span span = context.tree.expressions[id].span;
  if (variable->number.isInteger()) {
    if (!grammar.anyIndex)
      reportPoint(span, context, reporter);
    return;
  }
  reporter.report({.message = fmt::format("{} is not a variable: its number must be whole", context.quoted(span)),
                   .span = span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::VariableNotAvailable)),
                             "an operator may be missing between the variable and the number after it"}});
}

} // namespace

extern const Rule fractionalVariableNumber;
const Rule fractionalVariableNumber{.info = {"fractional-variable-number", Category::Variable, Severity::Error,
                                             "Reports a variable number with a fraction or with a decimal point."},
                                    .hooks = {.expression = check, .expressionNodes = nodeSet<NumberedVariable>()}};

} // namespace feedhold::rules::fractional_variable_number
