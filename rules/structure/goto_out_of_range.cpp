// goto-out-of-range: `GOTO 0`, `GOTO 123456` where sequence numbers have five digits.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::goto_out_of_range {
namespace {

void check(const Jump &jump, const FileContext &context, const Reporter &reporter) {
  if (!jump.number)
    return;
  const int first = context.dialect.grammar.sequenceZero ? 0 : 1;
  const std::uint32_t last = context.dialect.limits.lastSequenceNumber;
  if (Decimal::fromInteger(first) <= *jump.number && *jump.number <= Decimal::fromInteger(last))
    return;
  // A fraction is rounded to the nearest block number before the search.
  const double rounded = jump.number->toDouble();
  if (rounded >= first - 0.5 && rounded < last + 0.5)
    return;
  reporter.report(
      {.message = fmt::format("{} cannot be a sequence number; they go from {} to {}", context.quoted(jump.targetSpan),
                              first, last),
       .span = jump.targetSpan,
       .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::SequenceOutOfRange))}});
}

} // namespace

extern const Rule gotoOutOfRange;
const Rule gotoOutOfRange{.info = {"goto-out-of-range", Category::Structure, Severity::Error,
                                   "Reports a jump to a number that no block can have."},
                          .hooks = {.jump = check}};

} // namespace feedhold::rules::goto_out_of_range
