// unguarded-division: `#26/#17` where nothing asks whether Q was passed.
#include "rules/flow/passed_values.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::unguarded_division {
namespace {

/// By the analysis, or where that lost it, by the text.
std::optional<std::uint32_t> argumentIn(const FlowFacts &facts, std::uint32_t variable, const AbstractValue &value) {
  const auto &origin = value.origin();
  if (origin && origin->offset.isZero() && isEntrySymbol(origin->symbol) && isLocal(facts.file, origin->symbol))
    return origin->symbol;
  return argumentBehind(facts, variable);
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  std::vector<std::uint32_t> done;
  if (isMainProgram(facts))
    return; // never set at all: another rule's
  for (const AlarmFact &alarm : facts.alarms()) {
    if (alarm.kind != AlarmKind::DivideByZero || alarm.always)
      continue;
    const BlockId block = facts.node(alarm.node).block;
    const auto divisor = expressionAt(facts, block, alarm.place);
    const auto variable = divisor ? variableNumber(context.tree, unwrapped(context.tree, *divisor)) : std::nullopt;
    const AbstractValue *value = variable ? facts.valueOf(*divisor) : nullptr;
    const auto argument = value && isLocal(facts.file, *variable) ? argumentIn(facts, *variable, *value) : std::nullopt;
    if (!argument || !variable || std::ranges::find(done, *argument) != done.end() ||
        isTested(facts.file, facts.program, *argument) || isTested(facts.file, facts.program, *variable) ||
        mayHoldCallersValue(facts, *argument))
      continue;
    done.push_back(*argument);
    const PassedValues passed = passedFor(*argument, facts, context);
    if (passed.zero == PassedZero::Never)
      continue;
    Diagnostic diagnostic{.message = fmt::format("{} may be 0 or vacant: nothing checks it before this division",
                                                 describeVariable(context.dialect, *argument)),
                          .span = alarm.place,
                          .label = "divides by it",
                          .flow = pathFromEntry(facts, alarm.node),
                          .notes = {fmt::format("if it is not passed, or is 0, the control {}",
                                                stopsWith(context.dialect, AlarmKind::DivideByZero)),
                                    adviceToCheck(context.dialect, *argument)}};
    addPassed(diagnostic, passed, facts);
    reporter.report(std::move(diagnostic));
  }
}

} // namespace

extern const Rule unguardedDivision;
const Rule unguardedDivision{.info = {"unguarded-division", Category::Flow, Severity::Warning,
                                      "Reports a division by an argument that is never checked for 0."},
                             .hooks = {.flow = check}};

} // namespace feedhold::rules::unguarded_division
