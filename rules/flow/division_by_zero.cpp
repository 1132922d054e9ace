// division-by-zero: the divisor is 0 in all runs, or in some that the program itself leads there.
#include "rules/flow/flow_view.h"

#include <fmt/format.h>

namespace feedhold::rules::division_by_zero {
namespace {

/// The program itself makes it 0 on some path: one of the few values that it can have.
bool isProvablyPossible(const AbstractValue &divisor) {
  return divisor.mayBeNumber() && !divisor.number().set().isMany() && divisor.number().set().contains(0);
}

void checkAlarm(const AlarmFact &alarm, const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  const BlockId block = facts.node(alarm.node).block;
  const auto divisor = expressionAt(facts, block, alarm.place);
  const AbstractValue *value = divisor ? facts.valueOf(*divisor) : nullptr;
  if (!value || literalValue(context.tree, *divisor))
    return;
  if (!alarm.always && !isProvablyPossible(*value))
    return;
  const auto variable = variableNumber(context.tree, unwrapped(context.tree, *divisor));
  const std::string_view why = value->isVacant() && variable ? "is vacant here and counts as 0" : "is 0 here";
  Diagnostic diagnostic{
      .message = alarm.always ? fmt::format("divides by zero: {} {}", context.quoted(alarm.place), why)
                              : fmt::format("may divide by zero: {} can be 0 here", context.quoted(alarm.place)),
      .span = alarm.place,
      .flow = pathFromEntry(facts, alarm.node),
      .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::DivideByZero)),
                "correct the divisor, or check it for 0 before this block"}};
  if (alarm.always)
    reporter.report(std::move(diagnostic));
  else
    reporter.report(std::move(diagnostic), Severity::Warning);
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (const AlarmFact &alarm : facts.alarms())
    if (alarm.kind == AlarmKind::DivideByZero)
      checkAlarm(alarm, facts, context, reporter);
}

} // namespace

extern const Rule divisionByZero;
const Rule divisionByZero{.info = {"division-by-zero", Category::Flow, Severity::Error,
                                   "Reports a division whose divisor is always 0 or vacant."},
                          .hooks = {.flow = check}};

} // namespace feedhold::rules::division_by_zero
