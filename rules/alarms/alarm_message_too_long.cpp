// alarm-message-too-long: the end of the message does not fit the screen.
#include "findings/rule/rule.h"

#include "rules/alarms/alarm_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::alarm_message_too_long {
namespace {

/// Characters, not bytes: the message may be written in Japanese.
std::size_t characters(const std::string &utf8) {
  return static_cast<std::size_t>(
      std::ranges::count_if(utf8, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

void check(const Statement &statement, BlockId block, const FileContext &context, const Reporter &reporter) {
  const auto alarm = raisedAlarm(statement, block, context);
  if (!alarm || !alarm->comment || !alarm->comment->closed)
    return;
  const std::size_t limit = context.dialect.limits.alarmMessageLength;
  const std::size_t length = characters(messageOf(*alarm->comment, context));
  if (length <= limit)
    return;
  reporter.report(
      {.message = fmt::format("this alarm message has {} characters, but the control shows {}", length, limit),
       .span = alarm->comment->span,
       .notes = {"the operator does not see the rest; shorten the message"}});
}

} // namespace

extern const Rule alarmMessageTooLong;
const Rule alarmMessageTooLong{.info = {"alarm-message-too-long", Category::Alarm, Severity::Info,
                                        "Reports an alarm message that is longer than the control displays."},
                               .hooks = {.statement = check}};

} // namespace feedhold::rules::alarm_message_too_long
