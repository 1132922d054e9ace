#include "proof/replay/exact_run.h"

#include "base/support/mantissa32.h"
#include "proof/explore/exploration.h"
#include "proof/replay/start_inputs.h"

#include <algorithm>

namespace feedhold::prove {

/// Runs are single paths: a few thousand steps of one, and a few branches where something is not known.
ExploreOptions exactOptions() {
  ExploreOptions options;
  options.loops = LoopTreatment::EachIteration;
  options.mayEnclose = true;
  options.mayBeCalled = false;
  options.missingChangeNothing = true;
  options.mostSteps = 6'000;
  options.mostPaths = 20;
  options.mostWork = 1'000'000;
  options.mostTerms = 200'000;
  return options;
}

smt::Number inputNumber(const SymbolicInterpretation &interpretation, double value) {
  if (interpretation.arithmetic() == Arithmetic::Exact)
    return smt::Number::fromTyped(value);
  const bool isShort = numbersOfRun(interpretation.dialect()) == NumberModel::Mantissa32;
  return smt::Number::fromDouble(isShort ? mantissa32::nearest(value) : value);
}

void startExactly(SymbolicInterpretation &interpretation, const GivenVariables &given) {
  smt::TermStore &store = interpretation.store();
  std::map<std::uint32_t, SymbolicValue> values;
  for (const auto &[variable, value] : given.entries())
    values.emplace(variable, value.vacant
                                 ? interpretation.vacant()
                                 : SymbolicValue{store.no(), store.number(inputNumber(interpretation, value.number))});
  for (const auto &[variable, script] : given.readings.entries()) // a pin that is read is there
    if (variable >= kFirstNamedVariable && !isPredefinedName(variable))
      values.try_emplace(variable, store.no(), store.number(inputNumber(interpretation, script.front())));
  interpretation.startFrom(std::move(values));
  if (given.readings.entries().empty())
    return;
  std::map<std::uint32_t, std::vector<smt::TermId>> readings;
  for (const auto &[variable, script] : given.readings.entries())
    for (const double reading : script)
      readings[variable].push_back(store.number(inputNumber(interpretation, reading)));
  interpretation.readInputs(std::move(readings));
}

InputsKey keyOf(const GivenVariables &given) {
  InputsKey key;
  for (const auto &[variable, value] : given.entries())
    key.inputs.emplace_back(variable, value.vacant ? std::nullopt : std::optional(value.number));
  key.readings = given.readings.entries();
  key.start = given.start;
  return key;
}

Exploration exploreExactly(const ProgramSet &programs, Callee program, const GivenVariables &given) {
  smt::TermStore store;
  const Dialect &dialect = *programs.file(program.file).dialect;
  SymbolicInterpretation interpretation(store, dialect);
  startExactly(interpretation, given);
  interpretation.takeUsual(given.start.settings);
  const ModalTable modes(dialect);
  interpretation.keepPolar(modes.groupOf(ModalKind::Polar));
  SymbolicState entry = symbolicEntry(interpretation);
  setStart(interpretation, entry, given.start);
  ExploreOptions options = exactOptions();
  options.missing = MissingPrograms::Stop;
  return explore(interpretation, programs, program, entry, options);
}

bool ExactRuns::has(const Ends &ends, const RunResult &run) {
  const auto stopsAt = [&](std::optional<AlarmKind> alarm) {
    return std::find(ends.stops.begin(), ends.stops.end(), std::pair(run.place, alarm)) != ends.stops.end();
  };
  switch (run.end) {
  case RunEnd::Alarm: return stopsAt(run.alarm);
  case RunEnd::UserAlarm: return stopsAt(std::nullopt);
  case RunEnd::Fuel:
  case RunEnd::Repeats: return ends.repeats;
  case RunEnd::Unmodelled: return false;
  case RunEnd::M02:
  case RunEnd::M30:
  case RunEnd::EndOfFile:
  case RunEnd::Returned: return std::find(ends.exits.begin(), ends.exits.end(), run.place) != ends.exits.end();
  }
  return false;
}

ExactRuns::Ends ExactRuns::follow(const GivenVariables &given) const {
  const Exploration found = explore_(given);
  Ends ends;
  ends.repeats = !found.repeats.empty();
  ends.isIncomplete = found.incomplete.has_value();
  for (const StopSite &stop : found.stopSites)
    ends.stops.emplace_back(stop.place, stop.alarm);
  for (const PathExit &exit : found.exits)
    ends.exits.push_back(exit.place);
  const bool isOnePath = ends.stops.size() + ends.exits.size() + found.repeats.size() <= 1;
  if (!isOnePath && !given.readings.entries().empty()) { // which path takes which reading is not known
    ends = Ends();
    ends.isIncomplete = true;
  }
  return ends;
}

Agreement ExactRuns::agrees(const GivenVariables &given, const RunResult &run) {
  const auto [known, isNew] = known_.try_emplace(keyOf(given));
  if (isNew)
    known->second = follow(given);
  if (has(known->second, run))
    return Agreement::Same;
  const bool isOfCutter = run.end == RunEnd::Alarm && run.compensation; // its path is not followed exactly
  return known->second.isIncomplete || isOfCutter ? Agreement::NotKnown : Agreement::Different;
}

} // namespace feedhold::prove
