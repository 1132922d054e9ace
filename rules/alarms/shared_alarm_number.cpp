// shared-alarm-number: one number for two different faults.
#include "findings/rule/rule.h"

#include "rules/alarms/alarm_view.h"

#include <fmt/format.h>

#include <map>

namespace feedhold::rules::shared_alarm_number {
namespace {

struct FirstUse {
  Span span;
  std::string message;
};

void check(ProgramId id, const FileContext &context, const Reporter &reporter) {
  std::map<Decimal, FirstUse> firstUses;
  for (const VariableUse &use : context.model.variablesOf(id)) {
    if (!use.write || use.number != kAlarmVariable)
      continue;
    const Block &block = context.tree.blocks[use.block];
    const Block &next = context.tree.blocks[use.block.next()];
    for (const Statement &statement : context.tree.statements.slice(block.firstStatement, next.firstStatement)) {
      const auto alarm = raisedAlarm(statement, use.block, context);
      if (!alarm || !alarm->number || !alarm->comment)
        continue;
      const std::string message = messageOf(*alarm->comment, context);
      const auto [first, isNew] = firstUses.try_emplace(*alarm->number, FirstUse{alarm->span, message});
      if (isNew || first->second.message == message)
        continue;
      reporter.report({.message = fmt::format("alarm {} has two different messages", alarm->number->toString()),
                       .span = cover(alarm->span, alarm->comment->span),
                       .labels = {{first->second.span, "first used here"}},
                       .notes = {"give each fault its own number, so that the operator can look it up"}});
    }
  }
}

} // namespace

extern const Rule sharedAlarmNumber;
const Rule sharedAlarmNumber{.info = {"shared-alarm-number", Category::Alarm, Severity::Info,
                                      "Reports an alarm number that a program uses with different messages."},
                             .hooks = {.program = check}};

} // namespace feedhold::rules::shared_alarm_number
