#include "proof/prove/judge.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::prove {

namespace {

bool isForeseen(const Contract *contract, double number) {
  return contract && std::any_of(contract->alarms.begin(), contract->alarms.end(), [&](const AlarmPromise &promise) {
           return static_cast<double>(promise.number) == number;
         });
}

} // namespace

std::optional<std::string> denial(const Obligation &row, const Contract *contract, const RunResult &run) {
  const bool isHere = run.place == row.place && run.alarmSpan == row.span;
  if (row.kind == ObligationKind::NoControlAlarm && run.end == RunEnd::Alarm && isHere && run.alarm == row.alarm)
    return "the control stops here";
  if (row.kind == ObligationKind::AlarmUnreachable && run.end == RunEnd::UserAlarm && isHere &&
      !isForeseen(contract, run.alarmNumber))
    return fmt::format("stops with alarm {:.15g}", run.alarmNumber);
  if (row.kind == ObligationKind::ProgramEnds && run.end == RunEnd::Repeats)
    return "the run comes back to the same state and goes on for ever";
  return std::nullopt;
}

std::vector<Contradiction> judge(const WitnessSearch &witnesses, const Contract *contract,
                                 std::vector<Obligation> &rows) {
  std::vector<Contradiction> found;
  for (Obligation &row : rows)
    for (const WitnessSearch::Sample &run : witnesses.allRuns()) {
      if (!row.verdict.holds())
        break;
      const auto happened = denial(row, contract, run.result);
      if (!happened || !witnesses.allowed(run.given) || !witnesses.isExact(run.given, run.result))
        continue;
      found.push_back({row.id, std::string(nameOf(row.verdict)), {run.given, run.result.end, *happened}});
      row.verdict = Verdict::unknown("a run contradicts the proof that was found: this is a defect of Feedhold");
    }
  return found;
}

} // namespace feedhold::prove
