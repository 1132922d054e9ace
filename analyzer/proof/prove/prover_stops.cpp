// Places where a run may stop by itself.
#include "proof/prove/prover.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::prove {

using smt::TermId;

namespace {

/// Those that the contract foresees: for which calls they come, and whether for others too, its clauses say, which are
/// claims of their own (Prover::alarmPromises).
std::vector<std::uint32_t> foreseenAlarms(const Contract *contract) {
  std::vector<std::uint32_t> numbers;
  if (contract != nullptr)
    for (const AlarmPromise &promise : contract->alarms)
      numbers.push_back(promise.number);
  return numbers;
}

/// What a run that breaks the claim on this place does.
auto violationOf(const Check &check, const std::vector<std::uint32_t> &foreseen) {
  return [&check, &foreseen](const RunResult &run) -> std::optional<std::string> {
    const bool here = run.place == check.place && run.alarmSpan == check.span;
    const bool isForeseen = std::any_of(foreseen.begin(), foreseen.end(), [&](std::uint32_t number) {
      return static_cast<double>(number) == run.alarmNumber;
    });
    if (!check.alarm && here && run.end == RunEnd::UserAlarm && !isForeseen)
      return fmt::format("stops with alarm {:.15g}", run.alarmNumber);
    if (check.alarm && here && run.end == RunEnd::Alarm && run.alarm == *check.alarm)
      return "the control stops here";
    return std::nullopt;
  };
}

std::string claimOf(const Check &check, const std::vector<std::uint32_t> &foreseen) {
  if (check.alarm)
    return fmt::format("no {} here", meaningOf(*check.alarm));
  if (foreseen.empty())
    return "this alarm is never raised";
  return "no alarm comes from here that the contract does not foresee";
}

} // namespace

void Prover::stops() {
  const std::vector<std::uint32_t> foreseen = foreseenAlarms(contract());
  for (const Check &check : found_.checks) {
    const ObligationKind kind = check.alarm ? ObligationKind::NoControlAlarm : ObligationKind::AlarmUnreachable;
    if (!isOwn(check.place) || !wanted(kind))
      continue;
    std::vector<Query> queries;
    for (const CheckInstance &instance : check.instances) {
      const TermId isForeseen = check.alarm ? store_.no() : isOneOf(instance.number, foreseen);
      queries.push_back(onPath(instance.conditions, store_.implies(instance.stops, isForeseen)));
    }
    Obligation &obligation = add(kind, check.place, check.span, claimOf(check, foreseen));
    obligation.alarm = check.alarm;
    settle(obligation, queries, violationOf(check, foreseen));
  }
}

TermId Prover::isOneOf(const SymbolicValue &value, const std::vector<std::uint32_t> &numbers) {
  std::vector<TermId> any;
  for (const std::uint32_t number : numbers)
    any.push_back(store_.equal(value.number, reading_.number(number).number));
  return store_.logicalAnd(store_.logicalNot(value.vacant), store_.logicalOr(any));
}

/// Alarms that no path comes to.
void Prover::unmetAlarms() {
  if (!wanted(ObligationKind::AlarmUnreachable))
    return;
  for (const VariableUse &use : file().model->variablesOf(program_.program)) {
    const VariableRange *row = use.write && use.number ? findVariable(*file().dialect, *use.number) : nullptr;
    if (!row || row->role != VariableRole::Alarm ||
        std::any_of(found_.checks.begin(), found_.checks.end(), [&](const Check &check) {
          return !check.alarm && check.place.file == program_.file && programs_.node(check.place).block == use.block;
        }))
      continue;
    const Place place{program_.file, file().cfg.nodeOf(use.block)};
    settle(add(ObligationKind::AlarmUnreachable, place, file().tree->expressions[use.expression].span,
               "this alarm is never raised"),
           {}, [](const RunResult &) { return std::optional<std::string>(); });
  }
}

} // namespace feedhold::prove
