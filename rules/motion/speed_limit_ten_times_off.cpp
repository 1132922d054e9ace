// speed-limit-ten-times-off: `G50 S22000`, and `G50 S2200` for the next tool.
#include "rules/motion/turning_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace feedhold::rules::speed_limit_ten_times_off {
namespace {

std::vector<SpeedLimit> limitsOf(ProgramId program, const FileContext &context) {
  std::vector<SpeedLimit> limits;
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next())
    if (const auto limit = speedLimitIn(block, context); limit && limit->speed->isNumber())
      limits.push_back(*limit);
  return limits;
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Turning)
    return;
  const std::vector<SpeedLimit> limits = limitsOf(program, context);
  const auto withSpeed = [](double speed) {
    return [speed](const SpeedLimit &limit) { return limit.speed->number().toDouble() == speed; };
  };
  for (const SpeedLimit &limit : limits) {
    const double speed = limit.speed->number().toDouble();
    const auto tenth = std::ranges::find_if(limits, withSpeed(speed / 10));
    if (tenth == limits.end() || std::ranges::count_if(limits, withSpeed(speed)) > 1)
      continue;
    reporter.report(
        {.message = fmt::format("{} is ten times another limit of the spindle", context.quoted(limit.speed->span())),
         .span = limit.speed->span(),
         .labels = {{tenth->span(), "the other limit"}},
         .notes = {"with constant surface speed the spindle runs up to this limit where the tool is near the centre",
                   "check the zeros of S"}});
  }
}

} // namespace

extern const Rule speedLimitTenTimesOff;
const Rule speedLimitTenTimesOff{
    .info = {"speed-limit-ten-times-off", Category::Motion, Severity::Warning,
             "Reports a limit of the spindle of a lathe that is ten times another one in the program."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::speed_limit_ten_times_off
