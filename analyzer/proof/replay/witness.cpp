#include "proof/replay/witness.h"

#include "meaning/cfg/program_nodes.h"
#include "proof/decide/cancel.h"
#include "proof/smt/steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <fmt/format.h>
#include <numeric>

namespace feedhold::prove {

namespace {

constexpr std::uint64_t kStepsOfInput = 20; // of a model
constexpr std::uint64_t kStepsOfLook = 10;  // at a run, and at a movement of it
constexpr std::size_t kMostBreaking = 12;   // samples of which the nearest is the witness
constexpr std::size_t kMostReplays = 200;   // that are kept for the judge
constexpr std::size_t kMostInexact = 5;     // samples that break a claim by rounding, before the others are left alone

/// A third that has to be met exactly is met by no double: the same inputs with three places.
GivenVariables shortened(const GivenVariables &given, double (*whole)(double)) {
  GivenVariables near = given;
  for (const auto &[variable, value] : given.entries())
    if (!value.vacant)
      near.set(variable, ConcreteValue::of(whole(value.number * 1000) / 1000));
  for (auto &[variable, script] : near.readings.entries())
    for (double &reading : script)
      reading = whole(reading * 1000) / 1000;
  return near;
}

std::string howItEnded(const RunResult &run) {
  switch (run.end) {
  case RunEnd::M02:
  case RunEnd::M30:
  case RunEnd::Returned:
  case RunEnd::EndOfFile: return "the run ends without an alarm";
  case RunEnd::Alarm: return fmt::format("the control stops the run with an alarm: {}", meaningOf(run.alarm));
  case RunEnd::UserAlarm: return fmt::format("the run stops with alarm {:.15g}", run.alarmNumber);
  case RunEnd::Fuel: return fmt::format("the run had not ended after {} instructions", run.steps);
  case RunEnd::Repeats: return "the run repeats for ever";
  case RunEnd::Unmodelled: return "the run comes to a block that is not modelled";
  }
  FEEDHOLD_UNREACHABLE("the switch names every end");
}

/// Of several outcomes, a run takes the usual one; the counterexample may take another.
bool dependsOnControl(const smt::Model &model) {
  return std::ranges::any_of(model, [](const auto &named) {
    return named.first.starts_with(kUnknownTruth) || named.first.starts_with(kUnknownSetting);
  });
}

/// By block.
std::map<Place, std::vector<std::size_t>> samplesThatBreak(const BlockClaims &claims,
                                                           const std::vector<WitnessSearch::Sample> &samples) {
  std::map<Place, std::vector<std::size_t>> breaking;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    smt::spend(kStepsOfLook + kStepsOfLook * samples[i].result.moves.size());
    for (const Place block : claims.brokenIn(samples[i].result, samples[i].given))
      breaking[block].push_back(i);
  }
  return breaking;
}

} // namespace

WitnessSearch::WitnessSearch(SymbolicInterpretation &interpretation, const ProgramSet &programs, Callee entry,
                             std::vector<smt::TermId> demands, std::vector<double> constants)
    : interpretation_(interpretation), programs_(programs), entry_(entry), demands_(std::move(demands)),
      constants_(std::move(constants)), likely_(std::make_shared<LikelyCalls>(programs, entry)) {
  followExactly([&programs, entry](const GivenVariables &given) { return exploreExactly(programs, entry, given); });
}

std::vector<std::uint32_t> WitnessSearch::inputs() const {
  std::vector<std::uint32_t> inputs;
  for (const auto &[variable, value] : interpretation_.entryValues())
    inputs.push_back(variable);
  return inputs;
}

/// The inputs that the program reads; and what it reads where, on every path that is followed, something may have
/// changed it: in a run it may be as it was.
std::vector<std::uint32_t> WitnessSearch::variables() const {
  std::vector<std::uint32_t> all;
  for (const std::uint32_t variable : inputs())
    if (variable > kLocalVariables) // the others are inputs of each program, read or not
      all.push_back(variable);
  const ProgramFile &file = programs_.file(entry_.file);
  for (const VariableUse &use : file.model->variablesOf(entry_.program)) {
    const auto variable = use.write ? std::nullopt : variableOf(programs_, entry_.file, use);
    if (!variable || *variable == kVacantVariable || programs_.isLocalName(*variable))
      continue;
    const VariableRange *range = findVariable(*file.dialect, *variable);
    if (!range || range->role == VariableRole::Plain) // a name, or a number
      all.push_back(*variable);
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

smt::Model WitnessSearch::modelOf(const GivenVariables &given) const {
  smt::Model model;
  const smt::TermStore &store = interpretation_.store();
  smt::spend(kStepsOfInput * interpretation_.entryValues().size());
  open_.addTo(interpretation_, model, given.start);
  for (const auto &[variable, value] : interpretation_.entryValues()) {
    const ConcreteValue *held = given.find(variable);
    const bool vacant = !held || held->vacant;
    model[store[value.number].name] = vacant ? smt::Number(0) : numberOf(variable, held->number);
    if (store[value.vacant].kind == smt::TermKind::Variable)
      model[store[value.vacant].name] = vacant;
  }
  return model;
}

/// Of an input in steps: what was typed.
smt::Number WitnessSearch::numberOf(std::uint32_t variable, double held) const {
  return interpretation_.stepOf(variable) ? smt::Number::fromTyped(held) : inputNumber(interpretation_, held);
}

/// What can be typed for an input depends on its number alone, and the same numbers come again and again.
bool WitnessSearch::canBeTyped(std::uint32_t variable, const smt::Number &number, smt::TermId input) const {
  const auto [known, isNew] = canBeTyped_.try_emplace({variable, number}, false);
  if (isNew) {
    const smt::TermStore &store = interpretation_.store();
    const smt::Model model{{store[input].name, number}};
    const auto step = interpretation_.stepOf(variable);
    known->second = (!step || (number / *step).isInteger()) &&
                    std::ranges::all_of(interpretation_.typedInput(variable, input),
                                        [&](smt::TermId condition) { return smt::isTrue(store, condition, model); });
  }
  return known->second;
}

bool WitnessSearch::isAllowed(const GivenVariables &given) const {
  const smt::TermStore &store = interpretation_.store();
  smt::spend(kStepsOfInput * interpretation_.entryValues().size());
  for (const auto &[variable, value] : interpretation_.entryValues()) {
    const ConcreteValue *held = given.find(variable);
    const bool vacant = !held || held->vacant;
    if (!canBeTyped(variable, vacant ? smt::Number(0) : numberOf(variable, held->number), value.number))
      return false;
  }
  if (demands_.empty())
    return true;
  const smt::Model model = modelOf(given);
  smt::Evaluation evaluation(store, model, smt::OtherVariables::Unknown);
  return std::ranges::all_of(demands_, [&](smt::TermId demand) { return evaluation.is(demand, true); });
}

bool WitnessSearch::readsAnything(std::uint32_t variable) const {
  return isReadByName(programs_, *programs_.file(entry_.file).dialect, variable);
}

/// What is said of an input holds of each reading.
bool WitnessSearch::allowed(const GivenVariables &given) const {
  const Dialect &dialect = *programs_.file(entry_.file).dialect;
  GivenVariables first = given;
  for (const auto &[variable, script] : given.readings.entries()) {
    if (variable == kSkipShare && std::ranges::all_of(script, [](double share) { return 0 <= share && share <= 1; }))
      continue;
    const VariableRange *range = findVariable(dialect, variable);
    if (!readsAnything(variable) && (!range || !mayRead(*range, script)))
      return false;
    if (variable != programs_.returnedValue()) // of which nothing is said before a call
      first.set(variable, ConcreteValue::of(script.front()));
  }
  if (!isAllowed(first))
    return false;
  for (const auto &[variable, script] : given.readings.entries()) {
    if (!interpretation_.entryValues().contains(variable) || variable == programs_.returnedValue())
      continue;
    for (const double reading : std::set<double>(script.begin(), script.end())) {
      GivenVariables other = first;
      other.set(variable, ConcreteValue::of(reading));
      if (!isAllowed(other))
        return false;
    }
  }
  return true;
}

WitnessSearch WitnessSearch::narrowed(smt::TermId demand, const std::vector<smt::Model> &inputs) const {
  WitnessSearch narrowed(interpretation_, programs_, entry_, demands_, constants_);
  narrowed.startFrom(start_, place_, open_);
  narrowed.others_ = others_;
  narrowed.exactRuns_ = exactRuns_;
  narrowed.likely_ = likely_;
  narrowed.replays_ = replays_;
  narrowed.promised_ = promised_;
  narrowed.demands_.push_back(demand);
  for (std::size_t i = 0; i < inputs.size(); ++i)
    if (smt::isTrue(interpretation_.store(), demand, inputs[i]))
      narrowed.samples_.push_back(samples_[i]);
  return narrowed;
}

RunOptions WitnessSearch::runOptions(const GivenVariables &given) const {
  RunOptions options = start_;
  options.variables = given;
  options.numbers = numbersOfRun(*programs_.file(entry_.file).dialect);
  const smt::Model model = place_.empty() ? smt::Model() : modelOf(given);
  for (const auto &[axis, place] : place_)
    if (const auto value = smt::evaluate(interpretation_.store(), place, model))
      if (const auto *number = std::get_if<smt::Number>(&*value))
        options.start[indexOf(axis)] = number->toDouble();
  return options;
}

const geometry::PlainSpace &
WitnessSearch::spaceOf(const GivenVariables &given,
                       const std::function<geometry::PlainSpace(const RunOptions &)> &make) const {
  InputsKey key = keyOf(given);
  const auto known = spaces_.find(key);
  return known != spaces_.end() ? known->second
                                : spaces_.emplace(std::move(key), make(runOptions(given))).first->second;
}

RunResult WitnessSearch::runOf(const GivenVariables &given, WordRounding words) const {
  RunOptions options = runOptions(given);
  options.fuel = kFuel;
  options.words = words;
  return run(programs_, entry_, options);
}

bool WitnessSearch::passesPromised(const RunResult &run) const {
  return std::ranges::any_of(run.skipped, [&](const std::string &name) { return promised_.contains(name); });
}

/// Where an exact run decides, it takes what is passed over to do anything.
std::optional<std::string> WitnessSearch::broken(const Sample &run, const Violation &violation) const {
  const bool showsNothing = run.result.passedUnmodelled || (!violation.breaksExactly && passesPromised(run.result));
  return showsNothing ? std::nullopt : violation.happened(run.result, run.given);
}

/// All runs are looked at once for all blocks: a claim for each block and each clause would otherwise look at all moves
/// of all runs again.
std::vector<std::size_t> WitnessSearch::mayBreak(const Violation &violation) const {
  if (!violation.ofBlock) {
    std::vector<std::size_t> all(samples_.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  const auto &[claims, own] = *violation.ofBlock;
  auto known = breaking_.find(claims.clause);
  if (known == breaking_.end())
    known = breaking_.emplace(claims.clause, samplesThatBreak(claims, samples_)).first;
  const auto found = known->second.find(own);
  return found != known->second.end() ? found->second : std::vector<std::size_t>();
}

std::optional<Witness> WitnessSearch::amongSamples(const Violation &violation) const {
  std::optional<Witness> nearest;
  unsigned distance = 0;
  std::size_t exact = 0, inexact = 0;
  if (smt::areStepsUsedUp())
    return nearest;
  for (const std::size_t i : mayBreak(violation)) {
    if (exact >= kMostBreaking || inexact >= kMostInexact || smt::areStepsUsedUp())
      break;
    const Sample &sample = samples_[i];
    smt::spend(kStepsOfLook + kStepsOfLook * sample.result.moves.size());
    auto happened = broken(sample, violation);
    if (!happened)
      continue;
    if (!isExact(sample.given, sample.result, violation)) {
      inexact += i < firstPlain_ ? 0 : 1;
      continue;
    }
    ++exact;
    const unsigned found = likely_->distanceOf(sample.given);
    if (nearest && found >= distance)
      continue;
    distance = found;
    nearest = Witness{sample.given, sample.result.end, *std::move(happened)};
  }
  return nearest ? std::optional(plainest(*std::move(nearest), violation, kSampleFuel)) : std::nullopt;
}

std::optional<Witness> WitnessSearch::amongDecimals(const Violation &violation) const {
  constexpr std::size_t kMostFollowed = 12;
  std::vector<const Sample *> longest; // errors add up
  for (std::size_t i = firstDecimal_; i < samples_.size(); ++i)
    if (samples_[i].result.end != RunEnd::Fuel)
      longest.push_back(&samples_[i]);
  std::ranges::stable_sort(longest, std::greater(), [](const Sample *sample) { return sample->result.steps; });
  longest.resize(std::min(longest.size(), kMostFollowed));
  for (const Sample *sample : longest) {
    if (smt::areStepsUsedUp())
      break;
    if (auto witness = shown(*sample, violation))
      return plainest(*std::move(witness), violation, kSampleFuel);
  }
  return std::nullopt;
}

std::optional<Witness> WitnessSearch::shown(const Sample &run, const Violation &violation) const {
  const auto happened = broken(run, violation);
  if (!happened || !allowed(run.given) || !isExact(run.given, run.result, violation))
    return std::nullopt;
  return Witness{run.given, run.result.end, *happened};
}

/// Claims that a run alone does not break are judged in exact numbers.
std::optional<Witness> WitnessSearch::shownByRounding(const Sample &run, const Violation &violation) const {
  if (violation.breaksExactly)
    return std::nullopt;
  auto happened = broken(run, violation);
  if (!happened || !allowed(run.given) || agreesExactly(run.given, run.result) != Agreement::Different)
    return std::nullopt;
  return Witness{run.given, run.result.end, *happened + std::string(kByRounding)};
}

/// What happens only because the machine rounds is no witness against a claim over exact numbers.
bool WitnessSearch::isExact(const GivenVariables &given, const RunResult &run, const Violation &violation) const {
  if (violation.breaksExactly)
    return violation.breaksExactly(given);
  return interpretation_.arithmetic() != Arithmetic::Exact || isExact(given, run);
}

bool WitnessSearch::isExact(const GivenVariables &given, const RunResult &run) const {
  switch (agreesExactly(given, run)) {
  case Agreement::Same: return true;
  case Agreement::Different: return false;
  case Agreement::NotKnown: return run.end != RunEnd::Repeats; // doubles that grow or shrink come to rest
  }
  return false;
}

std::optional<Witness> WitnessSearch::tried(const GivenVariables &given, const Violation &violation,
                                            std::uint64_t fuel) const {
  throwIfCancelled();
  if (smt::areStepsUsedUp() || !allowed(given))
    return std::nullopt;
  RunOptions options = runOptions(given);
  options.fuel = fuel;
  const Sample replay{given, run(programs_, entry_, options)};
  smt::spend(kStepsOfInstruction * replay.result.steps);
  if (replays_->size() < kMostReplays)
    replays_->push_back(replay);
  return shown(replay, violation);
}

/// An input without a number, or with one beyond all doubles, is left out.
GivenVariables WitnessSearch::inputsOf(const smt::Model &model) const {
  const smt::TermStore &store = interpretation_.store();
  GivenVariables given;
  for (const auto &[variable, value] : interpretation_.entryValues()) {
    const auto number = model.find(store[value.number].name);
    const auto vacant =
        store[value.vacant].kind == smt::TermKind::Variable ? model.find(store[value.vacant].name) : model.end();
    if (vacant != model.end() && std::get<bool>(vacant->second))
      continue;
    const double nearest = number == model.end() ? 0 : std::get<smt::Number>(number->second).toDouble();
    if (number != model.end() && std::isfinite(nearest))
      given.set(variable, ConcreteValue::of(nearest));
    else if (vacant != model.end())
      given.set(variable, ConcreteValue::of(0));
  }
  addStartReads(given, model);
  addOffsets(given, model);
  given.start = open_.startOf(store, model);
  return given;
}

/// Of a variable that an index chooses, what the model says; but not against what it says of it by its number.
void WitnessSearch::addStartReads(GivenVariables &given, const smt::Model &model) const {
  const smt::TermStore &store = interpretation_.store();
  for (const auto &[index, value] : interpretation_.startReads()) {
    const auto number = model.find(store[value.number].name);
    const auto chosen = number == model.end() ? std::nullopt : smt::evaluate(store, index, model);
    const double cell = chosen ? std::floor(std::get<smt::Number>(*chosen).toDouble() + 0.5) : 0;
    if (!(cell > kLocalVariables) || !(cell < kFirstNamedVariable))
      continue;
    const auto variable = static_cast<std::uint32_t>(cell);
    const double held = std::get<smt::Number>(number->second).toDouble();
    if (!interpretation_.entryValues().contains(variable) && !given.find(variable) && std::isfinite(held) &&
        !smt::isTrue(store, value.vacant, model))
      given.set(variable, ConcreteValue::of(held));
  }
}

/// The model says what the reads of a path give, by their places; which read of the run that is, the run tells.  A read
/// of which the model says no more gives what the last one gave.
InputReadings WitnessSearch::readingsOf(const smt::Model &model, const GivenVariables &given) const {
  const smt::TermStore &store = interpretation_.store();
  std::map<std::pair<std::optional<Place>, std::uint32_t>, std::deque<double>> said;
  for (const InputRead &read : interpretation_.inputReads())
    if (const auto number = model.find(store[read.number].name); number != model.end())
      if (const double value = std::get<smt::Number>(number->second).toDouble(); std::isfinite(value))
        said[{read.place, read.variable}].push_back(value);
  InputReadings readings;
  if (said.empty())
    return readings;
  RunOptions options = runOptions(given);
  options.fuel = kSampleFuel;
  options.inputs = [&](Place place, std::uint32_t variable) {
    if (programs_.isInputName(variable) && !given.find(variable)) // the machine does not give it
      return 0.0;
    const std::vector<double> *before = readings.find(variable);
    std::vector<double> script = before ? *before : std::vector<double>();
    std::deque<double> &next = said[{place, variable}];
    const double reading = !next.empty() ? next.front() : script.empty() ? 0 : script.back();
    if (!next.empty())
      next.pop_front();
    if (script.size() < kLongestScript) {
      script.push_back(reading);
      readings.set(variable, std::move(script));
    }
    return reading;
  };
  smt::spend(kStepsOfInstruction * run(programs_, entry_, options).steps);
  return readings;
}

std::optional<Witness> WitnessSearch::fromModel(const smt::Model &model, const Violation &violation,
                                                std::uint64_t fuel) const {
  smt::Model whole = model;
  whole.insert(others_.begin(), others_.end());
  GivenVariables given = inputsOf(whole);
  given.readings = readingsOf(model, given);
  for (const GivenVariables &each : {given, shortened(given, std::floor), shortened(given, std::ceil)})
    if (const auto found = tried(each, violation, fuel))
      return plainest(*found, violation, fuel);
  return std::nullopt;
}

std::string WitnessSearch::whyNotShown(const smt::Model &model) const {
  constexpr std::string_view kNot = "the solver's counterexample did not reproduce on the machine";
  smt::Model whole = model;
  whole.insert(others_.begin(), others_.end());
  GivenVariables given = inputsOf(whole);
  given.readings = readingsOf(model, given);
  if (!allowed(given))
    return fmt::format("{}: rounded to its numbers, the inputs violate the contract", kNot);
  if (smt::areStepsUsedUp())
    return std::string(kNot);
  const RunResult result = runOf(given);
  smt::spend(kStepsOfInstruction * result.steps);
  if (result.passedUnmodelled)
    return fmt::format("{}, which passes over {}", kNot, result.notes.front().reason);
  return dependsOnControl(model)
             ? fmt::format("{}, and may depend on a parameter of the control or on what no manual says: {}", kNot,
                           howItEnded(result))
             : fmt::format("{}: {}", kNot, howItEnded(result));
}

} // namespace feedhold::prove
