// alarm-without-message: `#3000=1` and nothing that tells the operator why.
#include "findings/rule/rule.h"

#include "rules/alarms/alarm_view.h"

#include <fmt/format.h>

namespace feedhold::rules::alarm_without_message {
namespace {

void check(const Statement &statement, BlockId block, const FileContext &context, const Reporter &reporter) {
  const auto alarm = raisedAlarm(statement, block, context);
  if (!alarm || (alarm->comment && !messageOf(*alarm->comment, context).empty()))
    return;
  reporter.report({.message = fmt::format("alarm {} has no message", context.quoted(alarm->numberSpan)),
                   .span = alarm->span,
                   .notes = {"the operator sees only a number; write the reason in parentheses after it"}});
}

} // namespace

extern const Rule alarmWithoutMessage;
const Rule alarmWithoutMessage{.info = {"alarm-without-message", Category::Alarm, Severity::Warning,
                                        "Reports a `#3000=` without a message in parentheses after it."},
                               .hooks = {.statement = check}};

} // namespace feedhold::rules::alarm_without_message
