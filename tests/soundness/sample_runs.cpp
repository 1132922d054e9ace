#include "soundness/sample_runs.h"

#include "dialects/registry.h"
#include "inference/absint/analysis.h"
#include "language/parse/parse.h"
#include "soundness/containment.h"

#include <fmt/format.h>
#include <map>

namespace feedhold::soundness {

namespace {

/// The control as the analysis knows it, and as one machine has it: parameters that are unknown there are set here.
class Loaded {
public:
  Loaded(const ProgramLines &lines, Dialect dialect)
      : dialect_(std::move(dialect)), source_(SourceFile::fromText("sample.nc", textOf(lines))),
        tree_(parse(source_, dialect_)), model_(resolve(source_, tree_, dialect_)),
        set({{FileId(0), &source_, &tree_, &model_, &dialect_}}, CallGraph({{FileId(0), "", "", &model_}})) {}
  Loaded(const Loaded &) = delete;
  Loaded &operator=(const Loaded &) = delete;

  /// The first program, but for subroutines that stand before it.
  Callee main() const {
    ProgramId main(0);
    for (ProgramId id(0); id.index() < model_.programs.size(); id = id.next())
      if (dialect_.grammar.oWords && model_.programs[id].first.index() < model_.programs[main].first.index())
        main = id;
    return {FileId(0), set.file(FileId(0)).cfg.entryOf(main), main};
  }
  bool isEmpty() const { return model_.programs.empty(); }
  std::string blockOf(Place place) const {
    return std::string(source_.text(tree_.blocks[set.node(place).block].span()));
  }
  const Dialect &dialect() const { return dialect_; }

private:
  Dialect dialect_;
  SourceFile source_;
  SyntaxTree tree_;
  ProgramModel model_;

public:
  ProgramSet set;
};

const Dialect &controlOf(const Sample &sample) { return *findDialect(allDialects(), sample.dialect); }

Dialect machineOf(const Sample &sample, Random &random) {
  Dialect dialect = controlOf(sample);
  for (Switch *unknown : {&dialect.switches.dpi, &dialect.switches.nat})
    if (*unknown == Switch::Unknown)
      *unknown = random.oneIn(2) ? Switch::On : Switch::Off;
  return dialect;
}

/// All that the analysis tells.
class Foreseen : public AnalysisVisitor {
public:
  void visit(Place place, const AbstractState &state, std::span<const Place>) override {
    states[place].push_back(state);
  }
  void alarm(Truth truth, const AlarmReport &report) override {
    if (mayBeTrue(truth))
      alarms.push_back(report);
  }
  void userAlarm(const AbstractValue &, Span place) override { userAlarms.push_back(place); }

  bool hasAlarm(AlarmKind kind, Span place) const {
    return std::any_of(alarms.begin(), alarms.end(), [&](const AlarmReport &report) {
      return report.kind == kind && (report.place.empty() || report.place == place);
    });
  }

  std::map<Place, std::vector<AbstractState>> states;
  std::vector<AlarmReport> alarms;
  std::vector<Span> userAlarms;
};

class OneRun {
public:
  OneRun(const Loaded &machine, const Loaded &analysed, const Foreseen &foreseen, Random &random)
      : machine_(machine), analysed_(analysed), foreseen_(foreseen), modes_(machine.dialect()) {
    start(random);
  }

  std::optional<std::string> run(Tally &tally) {
    RunOptions options;
    options.variables = entry_.given;
    options.state = entry_.state;
    options.fuel = 250;
    options.blockSkip = skip_;
    options.trace = [this](const RunMoment &moment) { look(moment); };
    const RunResult result = feedhold::run(machine_.set, machine_.main(), options);
    ++tally.runs;
    tally.steps += steps_;
    tally.overflown += overflown_ ? 1 : 0;
    if (!why_ && !overflown_ && !overflows(result.state))
      ending(result);
    return std::move(why_);
  }

private:
  void start(Random &random) {
    GivenVariables &given = entry_.given;
    const bool vacancy = machine_.dialect().behaviour.variablesMayBeVacant;
    const auto value = [&] {
      return random.oneIn(3) ? (vacancy ? ConcreteValue{} : ConcreteValue::of(0)) : ConcreteValue::of(anyInput(random));
    };
    for (std::uint32_t local = 1; local <= kLocalVariables; ++local)
      if (findVariable(machine_.dialect(), local))
        given.set(local, value());
    for (const std::string_view result : {"_value", "_value_returned"}) // before any call has returned one
      if (const auto variable = machine_.set.variableNamed(result))
        given.set(*variable, ConcreteValue::of(0));
    for (const std::uint32_t common : {100, 101, 102, 105, 110, 120, 130, 500, 501})
      given.set(common, value());
    for (const std::uint32_t cell : {1000, 2001, 3001, 3012, 5061, 5201, 5221, 5222, 5241, 3901})
      given.set(cell, ConcreteValue::of(random.oneIn(3) ? 0 : anyInput(random)));
    std::array<double, kAxisCount> position{};
    for (double &axis : position)
      axis = anyInput(random);
    MachineState<ConcreteReading> &state = entry_.state =
        startState(ConcreteReading(machine_.dialect(), given), modes_, position);
    for (std::size_t group = 1; group < kModalGroups; ++group)
      if (const std::size_t codes = modes_.group(group).codes.size();
          codes != 0 && (!modes_.powerOn(group) || !random.oneIn(4)))
        state.codes[group] = static_cast<std::uint8_t>(random.below(static_cast<std::uint32_t>(codes)));
    if (const auto polar = modes_.groupOf(ModalKind::Polar)) // an assumption of the analysis: not in force at entry
      state.codes[*polar] = modes_.powerOn(*polar).value_or(ConcreteReading::kNoCode);
    for (ConcreteValue &word : state.words)
      word = value();
    for (auto *shifts : {&state.shift, &state.local})
      for (ConcreteValue &shift : *shifts)
        shift = ConcreteValue::of(random.oneIn(2) ? 0 : anyInput(random));
    state.lengthOffset = ConcreteValue::of(random.oneIn(2) ? 0 : anyInput(random));
    for (ConcreteValue *level : {&state.cycle.bottom, &state.cycle.retract, &state.cycle.initial, &state.cycle.peck})
      *level = value();
    state.spindle = static_cast<std::uint8_t>(random.below(kSpindleActions.size()));
    skip_ = random.oneIn(2) ? BlockSkipSwitch::On : BlockSkipSwitch::Off;
  }

  void look(const RunMoment &moment) {
    if (why_ || overflown_)
      return;
    ++steps_;
    overflown_ = overflows(moment.state);
    if (overflown_ || (steps_ > 60 && steps_ % 4 != 0))
      return;
    const auto found = foreseen_.states.find(moment.place);
    if (found == foreseen_.states.end()) {
      why_ = "a place that is not reached: " + machine_.blockOf(moment.place);
      return;
    }
    std::string reasons;
    for (const AbstractState &state : found->second) {
      const auto why = whyOutside(moment.state, state, entry_, modes_, analysed_.dialect());
      if (!why)
        return;
      reasons += "\n    " + *why;
    }
    why_ = fmt::format("before {}, step {}:{}", machine_.blockOf(moment.place), steps_, reasons);
  }
  void ending(const RunResult &result) {
    if (result.end == RunEnd::Alarm && !foreseen_.hasAlarm(result.alarm, result.alarmSpan))
      why_ = fmt::format("alarm {} at {}", static_cast<int>(result.alarm), machine_.blockOf(result.place));
    if (result.end == RunEnd::UserAlarm && std::find(foreseen_.userAlarms.begin(), foreseen_.userAlarms.end(),
                                                     result.alarmSpan) == foreseen_.userAlarms.end())
      why_ = "an alarm of the program at " + machine_.blockOf(result.place);
  }

  const Loaded &machine_;
  const Loaded &analysed_;
  const Foreseen &foreseen_;
  ModalTable modes_;
  EntryValues entry_;
  BlockSkipSwitch skip_{};
  std::uint64_t steps_ = 0;
  bool overflown_ = false;
  std::optional<std::string> why_;
};

} // namespace

std::optional<std::string> unforeseen(const Sample &sample, std::uint64_t inputSeed, int runs, Tally &tally) {
  Random random(inputSeed);
  const Loaded analysed(sample.lines, controlOf(sample));
  const Loaded machine(sample.lines, machineOf(sample, random));
  if (analysed.isEmpty())
    return std::nullopt;
  Foreseen foreseen;
  AnalysisOptions options;
  options.budget = 200'000;
  Analysis analysis(analysed.set, options);
  analysis.walk(analysed.main(), foreseen);
  if (analysis.gaveUp()) {
    tally.abandoned += static_cast<std::uint64_t>(runs);
    return std::nullopt;
  }
  for (int i = 0; i < runs; ++i)
    if (auto why = OneRun(machine, analysed, foreseen, random).run(tally))
      return fmt::format("run {}: {}", i, *why);
  return std::nullopt;
}

Sample shrunk(Sample sample, std::uint64_t inputSeed, int runs) {
  bool smaller = true;
  while (smaller) {
    smaller = false;
    for (std::size_t count = sample.lines.size() / 2; count > 0; count /= 2)
      for (std::size_t at = 0; at + count <= sample.lines.size();) {
        Sample fewer = sample;
        const auto first = fewer.lines.begin() + static_cast<std::ptrdiff_t>(at);
        fewer.lines.erase(first, first + static_cast<std::ptrdiff_t>(count));
        Tally tally;
        if (!fewer.lines.empty() && unforeseen(fewer, inputSeed, runs, tally)) {
          sample = std::move(fewer);
          smaller = true;
        } else {
          ++at;
        }
      }
  }
  return sample;
}

} // namespace feedhold::soundness
