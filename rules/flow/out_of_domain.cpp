// out-of-domain: SQRT of a negative number, ASIN beyond 1, in all runs or in some that the program itself leads there.
#include "rules/flow/flow_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::out_of_domain {
namespace {

/// The program itself has few values for it: that one of them is outside was not only not excluded.
bool isProvablyPossible(const AbstractValue &argument) {
  return argument.isNumber() && !argument.number().set().isMany();
}

/// The function whose argument stands there.
const FunctionCall *callWith(const FlowFacts &facts, BlockId block, Span argument) {
  const SyntaxTree &tree = *facts.file.tree;
  for (const ExpressionId id : expressionsOf(facts.file, block))
    if (const auto *call = as<FunctionCall>(tree, id);
        call && !call->arguments().empty() && tree.expressions[call->arguments().front()].span == argument)
      return call;
  return nullptr;
}

std::string shown(const AbstractValue &value) {
  const auto constant = value.isNumber() ? value.number().constantValue() : std::nullopt;
  return constant ? fmt::format(" ({:.6g})", *constant) : std::string();
}

void checkAlarm(const AlarmFact &alarm, const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  const FunctionCall *call = callWith(facts, facts.node(alarm.node).block, alarm.place);
  if (!call)
    return;
  const ExpressionId argument = call->arguments().front();
  const AbstractValue *value = facts.valueOf(argument);
  if (!value || literalValue(context.tree, argument) || (!alarm.always && !isProvablyPossible(*value)))
    return;
  const Span inner = context.tree.expressions[unwrapped(context.tree, argument)].span;
  Diagnostic diagnostic{
      .message = fmt::format("{}{} {} outside the range that {} accepts", context.quoted(inner), shown(*value),
                             alarm.always ? "is" : "can be", spellingOf(call->function)),
      .span = alarm.place,
      .flow = pathFromEntry(facts, alarm.node),
      .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::ArgumentOutOfDomain)),
                "correct the argument, or check it before this block"}};
  if (alarm.always)
    reporter.report(std::move(diagnostic));
  else
    reporter.report(std::move(diagnostic), Severity::Warning);
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (const AlarmFact &alarm : facts.alarms())
    if (alarm.kind == AlarmKind::ArgumentOutOfDomain)
      checkAlarm(alarm, facts, context, reporter);
}

} // namespace

extern const Rule outOfDomain;
const Rule outOfDomain{
    .info = {"out-of-domain", Category::Flow, Severity::Error,
             "Reports a function whose argument is always outside the range that the function accepts."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::out_of_domain
