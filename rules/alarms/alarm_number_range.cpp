// alarm-number-range: `#3000=500` where alarm numbers end at 200.
#include "findings/rule/rule.h"

#include "rules/alarms/alarm_view.h"

#include <fmt/format.h>

namespace feedhold::rules::alarm_number_range {
namespace {

// 6008#1 (MCA): the number is shown as it is, and may go up to here.
constexpr std::uint32_t kLastShownAsItIs = 4095;

std::uint32_t lastNumber(const Dialect &dialect) {
  return dialect.switches.mca == Switch::Off ? dialect.limits.lastAlarmNumber
                                             : std::max(dialect.limits.lastAlarmNumber, kLastShownAsItIs);
}

void check(const Statement &statement, BlockId block, const FileContext &context, const Reporter &reporter) {
  const auto alarm = raisedAlarm(statement, block, context);
  if (!alarm || !alarm->number)
    return;
  const std::uint32_t first = context.dialect.limits.firstAlarmNumber;
  const std::uint32_t last = lastNumber(context.dialect);
  if (Decimal::fromInteger(first) <= *alarm->number && *alarm->number <= Decimal::fromInteger(last))
    return;
  reporter.report(
      {.message = fmt::format("alarm number {} is outside the range {} to {}", alarm->number->toString(), first, last),
       .span = alarm->numberSpan,
       .notes = {"the control stops, but with an alarm of its own instead of this number and message",
                 fmt::format("use a number from {} to {}", first, last)}});
}

} // namespace

extern const Rule alarmNumberRange;
const Rule alarmNumberRange{.info = {"alarm-number-range", Category::Alarm, Severity::Error,
                                     "Reports a `#3000=` with an alarm number that the control does not accept."},
                            .hooks = {.statement = check}};

} // namespace feedhold::rules::alarm_number_range
