#include "soundness/sample_start.h"

#include "base/support/mantissa32.h"
#include "dialects/registry.h"

#include <map>
#include <mutex>

namespace feedhold::soundness {

const Dialect &controlOf(const Sample &sample) {
  const std::size_t slash = sample.dialect.find('/');
  const Dialect &plain = *findDialect(allDialects(), sample.dialect.substr(0, slash));
  if (slash == std::string_view::npos)
    return plain;
  static std::map<std::string_view, Dialect> others;
  static std::mutex guard;
  const std::scoped_lock lock(guard);
  const auto [other, isNew] = others.try_emplace(sample.dialect, plain);
  const std::string_view choice = sample.dialect.substr(slash + 1);
  if (isNew && choice == "lrp")
    other->second.switches.lrp = Switch::On;
  else if (isNew)
    chooseGCodeSystem(other->second, gCodeSystemNamed(choice).value());
  return other->second;
}

Dialect machineOf(const Sample &sample, Random &random) {
  Dialect dialect = controlOf(sample);
  Switches &switches = dialect.switches;
  for (Switch *unknown :
       {&switches.dpi, &switches.nat, &switches.g67, &switches.f16, &switches.fxy, &switches.ax1,
        &switches.shortArcStops, &switches.radiiDifferStops, &switches.pointArcStops, &switches.bareCycleStops,
        &switches.motionEndsCycle, &switches.setEndsLocal, &switches.centreStays, &switches.lrp})
    if (*unknown == Switch::Unknown)
      *unknown = random.oneIn(2) ? Switch::On : Switch::Off;
  return dialect;
}

NumberModel numbersOfMachine(const Dialect &control, Random &random) {
  const NumberModel numbers = numbersOf(control);
  if (numbers != NumberModel::Either)
    return numbers;
  return random.oneIn(2) ? NumberModel::Mantissa32 : NumberModel::Binary64;
}

EntryValues randomEntry(const LoadedSample &machine, Random &random) {
  return randomEntryIn(NumberModel::Binary64, machine, random);
}

EntryValues randomEntryIn(NumberModel numbers, const LoadedSample &machine, Random &random) {
  const ModalTable modes(machine.dialect());
  EntryValues entry;
  entry.numbers = numbers;
  GivenVariables &given = entry.given;
  const bool vacancy = machine.dialect().behaviour.variablesMayBeVacant;
  const auto value = [&] {
    if (random.oneIn(3))
      return vacancy ? ConcreteValue{} : ConcreteValue::of(0);
    const double number = anyInput(random);
    return ConcreteValue::of(numbers == NumberModel::Mantissa32 ? mantissa32::nearest(number) : number);
  };
  for (std::uint32_t local = 1; local <= kLocalVariables; ++local)
    if (findVariable(machine.dialect(), local))
      given.set(local, value());
  for (const std::string_view result : {kReturnedValue, kIsValueReturned}) // before any call has returned one
    if (const auto variable = machine.set.variableNamed(result))
      given.set(*variable, ConcreteValue::of(0));
  for (const std::uint32_t common : {100, 101, 102, 105, 110, 120, 130, 500, 501})
    given.set(common, value());
  for (const std::uint32_t cell : {1000, 2001, 3001, 3012, 5061, 5201, 5221, 5222, 5241, 3901})
    given.set(cell, ConcreteValue::of(random.oneIn(3) ? 0 : anyInput(random)));
  std::array<double, kAxisCount> position{};
  for (double &axis : position)
    axis = anyInput(random);
  MachineState<ConcreteInterpretation> &state = entry.state =
      startState(ConcreteInterpretation(machine.dialect(), given), modes, position);
  for (std::size_t group = 1; group < kModalGroups; ++group)
    if (const std::size_t codes = modes.group(group).codes.size();
        codes != 0 && (!modes.powerOn(group) || !random.oneIn(4)))
      state.codes[group] = static_cast<std::uint8_t>(random.below(static_cast<std::uint32_t>(codes)));
  if (const auto polar = modes.groupOf(ModalKind::Polar)) // an assumption of the analysis: not in force at entry
    state.codes[*polar] = modes.powerOn(*polar).value_or(ConcreteInterpretation::kNoCode);
  for (ConcreteValue &word : state.words)
    word = value();
  for (auto *shifts : {&state.shift, &state.local})
    for (ConcreteValue &shift : *shifts)
      shift = ConcreteValue::of(random.oneIn(2) ? 0 : anyInput(random));
  state.lengthOffset = ConcreteValue::of(random.oneIn(2) ? 0 : anyInput(random));
  for (ConcreteValue *level : {&state.cycle.bottom, &state.cycle.retract, &state.cycle.initial, &state.cycle.peck})
    *level = value();
  state.spindle = static_cast<std::uint8_t>(random.below(kSpindleActions.size()));
  return entry;
}

} // namespace feedhold::soundness
