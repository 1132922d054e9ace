#include "mutation/replay.h"

#include "base/support/match.h"
#include "meaning/semantics/evaluate.h"
#include "proof/space/plain_space.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace feedhold::mutation {

using geometry::SpaceClaim;
using prove::ObligationKind;
using soundness::EntryValues;
using soundness::ProgramLines;
using soundness::Random;

namespace {

constexpr std::uint64_t kFuel = 20'000;
constexpr std::size_t kMostMoves = 5'000;
constexpr double kNoise = 1e-6; // of sums of doubles; less is neither a gouge nor a broken promise

using State = MachineState<ConcreteInterpretation>;

bool hasEnded(RunEnd end) {
  return end == RunEnd::M02 || end == RunEnd::M30 || end == RunEnd::Returned || end == RunEnd::EndOfFile;
}

/// A promise in the state behind a run, with room for what doubles round.
class RoundedPromise {
public:
  explicit RoundedPromise(StepContext<ConcreteInterpretation> &context) : context_(context) {}

  bool mayHold(ExpressionId id) {
    if (evaluateCondition(context_, id))
      return true;
    const ExpressionId inner = unwrapped(context_.tree(), id);
    const auto *operation = std::get_if<BinaryOperation>(&context_.tree().expressions[inner].node);
    if (!operation)
      return false;
    if (operation->op == OperatorKind::And)
      return mayHold(operation->left) && mayHold(operation->right);
    if (operation->op == OperatorKind::Or)
      return mayHold(operation->left) || mayHold(operation->right);
    if (!isRelation(operation->op) || operation->op == OperatorKind::NotEqual)
      return false;
    const ConcreteValue left = evaluate(context_, operation->left);
    const ConcreteValue right = evaluate(context_, operation->right);
    return left.vacant == right.vacant && std::fabs(left.number - right.number) <= kNoise;
  }

private:
  StepContext<ConcreteInterpretation> &context_;
};

ConcreteValue changed(const ConcreteValue &value, Random &random) {
  switch (random.below(4)) {
  case 0: return {};
  case 1: return ConcreteValue::of(-value.number);
  case 2: return ConcreteValue::of(value.number * 100);
  default: return ConcreteValue::of(value.number / 100);
  }
}

double placeOf(Random &random) { return static_cast<double>(random.below(200)) / 4 - 25; }

void add(std::vector<Break> &breaks, Break found) {
  if (std::none_of(breaks.begin(), breaks.end(), [&](const Break &known) { return known.isOfSameClaim(found); }))
    breaks.push_back(std::move(found));
}

} // namespace

struct ReplayedProgram::Region {
  ObligationKind kind;
  SpaceClaim claim;
  std::size_t index;
  std::string name;
};
struct ReplayedProgram::Run {
  const Start &start;
  std::size_t number;
  EntryValues entry;
  RunResult result;
};

ReplayedProgram::ReplayedProgram(std::string_view dialect, const ProgramLines &lines)
    : loaded_(lines, soundness::controlOf({dialect, lines})),
      contracts_(readContracts(loaded_.source(), loaded_.tree(), loaded_.model(), loaded_.dialect())),
      promises_(loaded_, contracts_, contract()) {}

std::string ReplayedProgram::textOf(const Start &start) const {
  std::string text;
  for (const auto &[variable, value] : start.given.entries())
    text += value.vacant ? fmt::format("#{} vacant ", variable) : fmt::format("#{}={} ", variable, value.number);
  return text + fmt::format("at X{} Y{} Z{}", start.place[0], start.place[1], start.place[2]);
}

RunOptions ReplayedProgram::optionsOf(const Start &start) const {
  RunOptions options;
  options.variables = start.given;
  options.start = start.place;
  options.fuel = kFuel;
  options.mostMoves = kMostMoves;
  options.words = WordRounding::None;
  return prove::followedAsSaid(loaded_.set, entry(), &contracts_,
                               prove::startedAsSaid(loaded_.set, entry(), contracts_, std::move(options)));
}

RunResult ReplayedProgram::run(const Start &start) const {
  return feedhold::run(loaded_.set, entry(), optionsOf(start));
}

EntryValues ReplayedProgram::entryOf(const Start &start) const {
  const ModalTable modes(loaded_.dialect());
  EntryValues entry{startState(ConcreteInterpretation(loaded_.dialect(), start.given), modes, start.place),
                    start.given};
  promises_.prepare(entry);
  return entry;
}

// ---- calls ----

std::vector<Start> ReplayedProgram::starts(Random &random, int count) const {
  std::vector<Start> all;
  for (int i = 0; i < count; ++i)
    if (auto start = allowedStart(random))
      all.push_back(std::move(*start));
  if (contract() && contract()->guarded)
    for (int i = 0; i < count / 3; ++i)
      if (auto start = forbiddenStart(random))
        all.push_back(std::move(*start));
  return all;
}

std::optional<Start> ReplayedProgram::allowedStart(Random &random) const {
  constexpr int kTries = 3'000;
  Start start;
  for (double &axis : start.place)
    axis = placeOf(random);
  for (int i = 0; i < kTries; ++i) {
    EntryValues entry = entryOf(start);
    promises_.draw(entry, random);
    promises_.draw(entry, random); // once more: a range may name an argument that comes later
    if (!promises_.allows(entry))
      continue;
    start.given = entry.given;
    if (!startsInKeepOut(start))
      return start;
    for (double &axis : start.place)
      axis = placeOf(random);
  }
  return std::nullopt;
}

/// `@MACHINE` without a `@START`: the operator has the tool outside of what it must not touch (docs/geometry.md).
bool ReplayedProgram::startsInKeepOut(const Start &start) const {
  const geometry::PlainSpace space = prove::plainSpace(loaded_.set, entry(), contracts_, optionsOf(start));
  if (!space.machine || contract()->start)
    return false;
  const Place head{FileId(0), entry().entry};
  RecordedMove standing{
      .move = {}, .unit = LengthUnit::Millimetre, .place = head, .own = head, .length = LengthInForce::None};
  for (std::size_t axis = 0; axis < start.place.size(); ++axis)
    standing.move.start[axis] = standing.move.end[axis] = ConcreteValue::of(start.place[axis]);
  for (std::size_t i = 0; i < space.keepOut.size(); ++i)
    if (geometry::deepestGouge(space, SpaceClaim::KeepOut, i, std::array{standing}))
      return true;
  return false;
}

/// One that is allowed, with one argument that is not.
std::optional<Start> ReplayedProgram::forbiddenStart(Random &random) const {
  std::optional<Start> start = allowedStart(random);
  if (!start || start->given.entries().empty())
    return std::nullopt;
  auto &entries = start->given.entries();
  ConcreteValue &value = entries[random.below(static_cast<std::uint32_t>(entries.size()))].second;
  value = changed(value, random);
  if (promises_.allows(entryOf(*start)))
    return std::nullopt;
  start->contract = Start::Contract::Forbids;
  return start;
}

// ---- what a run breaks ----

std::vector<Break> ReplayedProgram::breaks(const std::vector<Start> &starts) const {
  std::vector<Break> breaks;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const Run run{starts[i], i, entryOf(starts[i]), this->run(starts[i])};
    if (run.start.contract == Start::Contract::Forbids) {
      if (!run.result.moves.empty() || hasEnded(run.result.end))
        add(breaks, {ObligationKind::Guarded, run.result.place, "", {}, "moves or ends without an alarm", i});
      continue;
    }
    addPromises(breaks, run);
    addStop(breaks, run);
    addGouges(breaks, run);
  }
  return breaks;
}

std::vector<Break> ReplayedProgram::breaksAround(const Start &start) const {
  constexpr int kAround = 24;
  constexpr int kMost = 20;
  Random random(1);
  std::vector<std::pair<Break, int>> all;
  for (int i = 0; i < kAround; ++i) {
    Start near = start;
    for (auto &[variable, value] : near.given.entries())
      if (std::floor(value.number) != value.number || std::fabs(value.number) > 8) // no class, no strategy
        value.number *= 1 + (static_cast<double>(random.below(2'000)) - 1'000) * 1e-8;
    for (Break &found : breaks({near})) {
      const auto known =
          std::find_if(all.begin(), all.end(), [&](const auto &each) { return each.first.isOfSameClaim(found); });
      if (known == all.end())
        all.emplace_back(std::move(found), 1);
      else
        ++known->second;
    }
  }
  std::vector<Break> most;
  for (auto &[found, times] : all)
    if (times >= kMost)
      most.push_back(std::move(found));
  return most;
}

bool ReplayedProgram::clearlyBreaks(ExpressionId condition, const EntryValues &entry, const RunResult &result) const {
  State state = result.state;
  for (const Axis axis : kAllAxes) {
    state.variables.set(positionVariable(letterOf(axis)), result.state.at(axis));
    state.variables.set(entryVariable(letterOf(axis)), entry.state.at(axis));
  }
  for (std::uint32_t local = 1; local <= kLocalVariables; ++local)
    state.variables.set(oldVariable(local), entry.state.locals[local]);
  for (const auto &[variable, value] : entry.given.entries())
    state.variables.set(oldVariable(variable), value);
  const ProgramFile &program = loaded_.set.file(FileId(0));
  const ProgramFile within{.file = program.file,
                           .source = program.source,
                           .tree = &contracts_.tree,
                           .model = program.model,
                           .dialect = program.dialect};
  const ModalTable modes(loaded_.dialect());
  ConcreteInterpretation interpretation(loaded_.dialect(), entry.given);
  StepContext<ConcreteInterpretation> context{interpretation, state, loaded_.set, within, modes, BlockId(0)};
  const bool mayHold = RoundedPromise(context).mayHold(condition);
  return !mayHold && !interpretation.stopped();
}

void ReplayedProgram::addPromises(std::vector<Break> &breaks, const Run &run) const {
  const RunEnd end = run.result.end;
  const Place head{FileId(0), entry().entry};
  const auto addIf = [&](ObligationKind kind, const std::string &clause) {
    const prove::Obligation promise{.kind = kind, .id = {}, .place = head, .span = {}, .claim = clause};
    if (const auto why = promises_.broken(promise, run.entry, run.result))
      add(breaks, {kind, head, clause, {}, *why, run.number});
  };
  if (!contract())
    return;
  for (const Ensure &ensure : contract()->ensures) {
    const std::string &clause = contracts_.clauses[ensure.clause].text;
    const auto *condition = std::get_if<ExpressionId>(&ensure.promise);
    if (!condition)
      addIf(std::holds_alternative<ModalPreserved>(ensure.promise) ? ObligationKind::ModalPreserved
                                                                   : ObligationKind::Ensures,
            clause);
    else if (hasEnded(end) && clearlyBreaks(*condition, run.entry, run.result))
      add(breaks, {ObligationKind::Ensures, head, clause, {}, "the run ends and it does not hold", run.number});
  }
  if (!contract()->assigns.empty())
    addIf(ObligationKind::Assigns, "");
  if (hasEnded(end) || end == RunEnd::UserAlarm || end == RunEnd::Alarm)
    for (const AlarmPromise &alarm : contract()->alarms)
      addIf(ObligationKind::AlarmIff, contracts_.clauses[alarm.clause].text);
}

/// Of stops in programs that are called, their own contracts speak.
void ReplayedProgram::addStop(std::vector<Break> &breaks, const Run &run) const {
  const RunResult &result = run.result;
  const bool isOwn =
      loaded_.model().programOf(loaded_.set.node(result.place).block) == entry().program && result.calls.empty();
  if (result.end == RunEnd::Repeats)
    add(breaks, {ObligationKind::ProgramEnds, {FileId(0), entry().entry}, "", {}, "goes round for ever", run.number});
  if (!isOwn)
    return;
  if (result.end == RunEnd::Alarm && result.compensation)
    return add(breaks, {ObligationKind::Compensation,
                        *result.compensation,
                        "",
                        {},
                        fmt::format("{} at {}", meaningOf(result.alarm), loaded_.blockOf(result.place)),
                        run.number});
  if (result.end == RunEnd::Alarm)
    add(breaks, {ObligationKind::NoControlAlarm, result.place, std::string(meaningOf(result.alarm)), result.alarmSpan,
                 fmt::format("{} at {}", meaningOf(result.alarm), loaded_.blockOf(result.place)), run.number});
  const bool isNamed =
      contract() && std::any_of(contract()->alarms.begin(), contract()->alarms.end(), [&](const AlarmPromise &alarm) {
        return static_cast<double>(alarm.number) == result.alarmNumber;
      });
  if (result.end == RunEnd::UserAlarm && !isNamed)
    add(breaks, {ObligationKind::AlarmUnreachable, result.place, "", result.alarmSpan,
                 fmt::format("alarm {}", result.alarmNumber), run.number});
}

void ReplayedProgram::addGouges(std::vector<Break> &breaks, const Run &run) const {
  const geometry::PlainSpace space = prove::plainSpace(loaded_.set, entry(), contracts_, optionsOf(run.start));
  for (std::size_t i = 0; i < space.keepIn.size(); ++i)
    addGougesOf(breaks, run, space, {ObligationKind::KeepIn, SpaceClaim::KeepIn, i, space.keepIn[i].name});
  for (std::size_t i = 0; i < space.keepOut.size(); ++i)
    addGougesOf(breaks, run, space, {ObligationKind::KeepOut, SpaceClaim::KeepOut, i, space.keepOut[i].name});
  if (space.clearance)
    addGougesOf(breaks, run, space, {ObligationKind::Clearance, SpaceClaim::Clearance, 0, ""});
  if (space.travel)
    addGougesOf(breaks, run, space, {ObligationKind::Travel, SpaceClaim::Travel, 0, ""});
  if (space.machine)
    addGougesOf(breaks, run, space, {ObligationKind::Travel, SpaceClaim::Machine, 0, "MACHINE"});
}

/// Of each block that breaks it: the deepest of all blocks, then of all the others.
void ReplayedProgram::addGougesOf(std::vector<Break> &breaks, const Run &run, const geometry::PlainSpace &space,
                                  const Region &region) const {
  const std::vector<RecordedMove> &moves = run.result.moves;
  std::vector<Place> known;
  for (const Break &each : breaks)
    if (each.kind == region.kind && each.name == region.name)
      known.push_back(each.place);
  while (true) {
    const auto gouge = geometry::deepestGouge(space, region.claim, region.index, moves, [&](const RecordedMove &move) {
      return std::find(known.begin(), known.end(), move.own) == known.end();
    });
    if (!gouge || gouge->depth < kNoise)
      return;
    const Place own = moves[gouge->move].own;
    const auto &[x, y, z] = gouge->at;
    add(breaks, {region.kind,
                 own,
                 region.name,
                 {},
                 fmt::format("{:.6g} deep at X{:.6g} Y{:.6g} Z{:.6g}, {}", gouge->depth, x, y, z, loaded_.blockOf(own)),
                 run.number});
    known.push_back(own);
  }
}

} // namespace feedhold::mutation
