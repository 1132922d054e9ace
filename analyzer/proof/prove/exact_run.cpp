#include "proof/prove/exact_run.h"

#include "proof/prove/exploration.h"

#include <algorithm>

namespace feedhold::prove {

/// Runs are single paths: a few thousand steps of one, and a few branches where something is not known.
ExploreOptions exactOptions() {
  ExploreOptions options;
  options.loops = LoopTreatment::EachPass;
  options.mostSteps = 6'000;
  options.mostPaths = 20;
  options.mostWork = 1'000'000;
  options.mostTerms = 200'000;
  return options;
}

void startExactly(SymbolicReading &reading, const GivenVariables &given) {
  smt::TermStore &store = reading.store();
  std::map<std::uint32_t, SymbolicValue> values;
  for (const auto &[variable, value] : given.entries())
    values.emplace(variable, value.vacant
                                 ? reading.vacant()
                                 : SymbolicValue{store.no(), store.number(smt::Number::fromTyped(value.number))});
  reading.startFrom(std::move(values));
}

namespace {

bool hasStop(const Exploration &found, const RunResult &run) {
  return std::any_of(found.checks.begin(), found.checks.end(), [&](const Check &check) {
    return check.place == run.place &&
           check.alarm == (run.end == RunEnd::Alarm ? std::optional(run.alarm) : std::nullopt);
  });
}

bool hasEnd(const Exploration &found, const RunResult &run) {
  switch (run.end) {
  case RunEnd::Alarm:
  case RunEnd::UserAlarm: return hasStop(found, run);
  case RunEnd::Fuel:
  case RunEnd::Repeats: return !found.repeats.empty();
  case RunEnd::NotModelled: return false;
  case RunEnd::M02:
  case RunEnd::M30:
  case RunEnd::EndOfFile:
  case RunEnd::Returned:
    return std::any_of(found.exits.begin(), found.exits.end(),
                       [&](const PathExit &exit) { return exit.place == run.place; });
  }
  return false;
}

} // namespace

Agreement agreesExactly(const ProgramSet &programs, Callee entry, const GivenVariables &given, const RunResult &run) {
  smt::TermStore store;
  SymbolicReading reading(store, *programs.file(entry.file).dialect);
  startExactly(reading, given);
  const ModalTable modes(*programs.file(entry.file).dialect);
  reading.keepPolar(modes.groupOf(ModalKind::Polar));
  const Exploration found = explore(reading, programs, entry, symbolicEntry(reading), exactOptions());
  if (hasEnd(found, run))
    return Agreement::Same;
  return found.incomplete ? Agreement::NotKnown : Agreement::Different;
}

} // namespace feedhold::prove
