// shared-alarm-number: one number for two different faults.
#include "findings/rule/rule.h"

#include "rules/alarms/alarm_view.h"

#include <fmt/format.h>

#include <map>

namespace feedhold::rules {
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
      reporter.report(
          {.message = fmt::format("alarm {} has another message here than before", alarm->number->toString()),
           .span = cover(alarm->span, alarm->comment->span),
           .labels = {{first->second.span, "first used here"}},
           .notes = {"a number of its own for each fault lets the operator look it up"}});
    }
  }
}

} // namespace

extern const Rule sharedAlarmNumber;
const Rule sharedAlarmNumber{.info = {"shared-alarm-number", Category::Alarm, Severity::Info,
                                      "Reports two alarms of a program that have one number but different messages."},
                             .hooks = {.program = check}};

} // namespace feedhold::rules
