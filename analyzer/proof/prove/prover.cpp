#include "proof/prove/prover.h"

#include "meaning/cfg/wto.h"
#include "meaning/semantics/mappings.h"
#include "proof/prove/entails.h"
#include "proof/prove/exact_run.h"
#include "proof/prove/loop_account.h"
#include "proof/prove/recurrence.h"
#include "proof/prove/stop.h"
#include "proof/smt/steps.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace feedhold::prove {

using smt::TermId;

std::string_view nameOf(ObligationKind kind) {
  constexpr std::array<std::string_view, 16> kNames = {
#define OBLIGATION(kind, name) name,
#include "proof/prove/obligation_kinds.def"
  };
  return kNames[static_cast<std::size_t>(kind)];
}
std::string_view nameOf(Verdict verdict) {
  switch (verdict) {
  case Verdict::Proved: return "proved";
  case Verdict::Refuted: return "refuted";
  case Verdict::Unknown: return "unknown";
  case Verdict::Unreachable: return "unreachable";
  }
  FEEDHOLD_UNREACHABLE("the switch names every verdict");
}
std::string_view nameOf(Grade grade) { return grade == Grade::Certified ? "certified" : "two-solvers"; }

Prover::Prover(const ProgramSet &programs, Callee program, const FileContracts *contracts, const ProveOptions &options)
    : programs_(programs), program_(program), contracts_(contracts), options_(options),
      reading_(store_, *programs.file(program.file).dialect), entry_(symbolicEntry(reading_)) {}

Prover::Prover(const ProgramSet &programs, Callee program, const FileContracts *contracts, const ProveOptions &options,
               const GivenVariables &given)
    : Prover(programs, program, contracts, options) {
  isSingleRun_ = true;
  startExactly(reading_, given);
  entry_ = symbolicEntry(reading_);
}

const Contract *Prover::contract() const { return contracts_ ? contracts_->of(program_.program) : nullptr; }

ProgramProof Prover::run() {
  explore();
  settleAll();
  followPasses();
  if (contract())
    satisfiable(); // the last word on all of them
  checkRounding();
  if (options_.guards == InferGuards::Yes)
    guards();
  std::stable_sort(proof_.obligations.begin(), proof_.obligations.end(), [](const Obligation &a, const Obligation &b) {
    return std::pair(a.kind, a.span.begin) < std::pair(b.kind, b.span.begin);
  });
  std::map<std::string, int> names;
  for (Obligation &obligation : proof_.obligations)
    if (const int number = ++names[obligation.id]; number > 1)
      obligation.id += fmt::format(".{}", number);
  if (contract() && !contract()->isSound)
    withdraw("a clause of the contract could not be read");
  return std::move(proof_);
}

void Prover::settleAll() {
  stops();
  unmetAlarms();
  loops();
  programEnds();
  promises();
  spaces();
  if (contract())
    guarded();
}

void Prover::promises() {
  callsMeetContracts();
  if (!contract())
    return;
  ensures();
  assigns();
  alarmPromises();
  limits();
}

/// What rests on a contract that is not what its author meant is not told.
void Prover::withdraw(std::string_view reason) {
  for (Obligation &obligation : proof_.obligations) {
    obligation.verdict = Verdict::Unknown;
    obligation.grade.reset();
    obligation.witness.reset();
    obligation.evidence.clear();
    obligation.method.clear();
    obligation.reason = reason;
  }
}

void Prover::explore() {
  const ModalTable modes(*file().dialect);
  if (const auto polar = modes.groupOf(ModalKind::Polar)) {
    reading_.keepPolar(*polar);
    const CodeMask off = modes.maskOf(ModalKind::Polar, {CodeAction::PolarOff});
    if (off != 0)
      entry_.codes[*polar] = reading_.code(static_cast<std::uint8_t>(std::countr_zero(off)));
  }
  startCodes_ = entry_.codes;
  if (contract()) {
    terms_ = std::make_unique<ContractTerms>(reading_, programs_, program_.file, *contracts_);
    const auto anyCodes = entry_.codes;
    terms_->prepare(*contract(), entry_);
    startCodes_ = entry_.codes;
    leaveMappingsOpen(anyCodes);
    demands_ = terms_->demands(*contract(), entry_);
    space_ = std::make_unique<SpaceClaims>(store_, *terms_, *contract(), entry_);
  }
  found_ = prove::explore(reading_, programs_, program_, entry_, exploreOptions());
  proof_.unfollowed = found_.unfollowed;
  proof_.incomplete = found_.incomplete;
  if (isSingleRun_)
    return;
  witnesses_ = std::make_unique<WitnessSearch>(reading_, programs_, program_, demands_, constants());
  start(*witnesses_);
  if (!contract())
    return;
  anyCall_ = discharge(store_, onPath(demands_, store_.no()), options_.budget);
  if (const smt::Model *model = anyCall_->counterexample())
    witnesses_->sampleAround(*model);
  witnesses_->sampleEnds(terms_->inputEnds(*contract(), entry_));
}

/// A mapping whose code is certain is taken to be the program's own; one of the caller ends with what was known of the
/// position, so that its code is left open.
void Prover::leaveMappingsOpen(const decltype(SymbolicState::codes) &anyCodes) {
  for (const ModalCode &code : contract()->modal) {
    const Code *row = code.address == 'G' ? findGCode(*file().dialect, code.tenths) : nullptr;
    if (row && beginsMapping(row->action))
      entry_.codes[row->group] = anyCodes[row->group];
  }
}

/// The machine starts with the codes and at the place that the contract says.
void Prover::start(WitnessSearch &witnesses) const {
  const auto numberOf = [&](TermId term) -> std::optional<double> {
    return store_.isNumber(term) ? std::optional(store_[term].number.toDouble()) : std::nullopt;
  };
  RunOptions options;
  for (std::size_t group = 0; group < kModalGroups; ++group)
    if (const auto code = numberOf(startCodes_[group].index))
      options.codes.emplace_back(static_cast<std::uint8_t>(group), static_cast<std::uint8_t>(*code));
  std::map<Axis, TermId> place;
  for (const Axis axis : kAllAxes)
    place.emplace(axis, entry_.at(axis).number);
  witnesses.startFrom(std::move(options), std::move(place));
  witnesses.sample();
}

/// Hints are tried, never believed: an invariant has to hold before each pass, a measure has to fall.
LoopHints Prover::hintsOf(const std::vector<LoopHint> &hints, const HintTerm &termOf) const {
  return [this, &hints, termOf](Place head, const SymbolicState &state) {
    std::vector<TermId> terms;
    for (const LoopHint &hint : hints)
      if (head.file == program_.file && programs_.node(head).block == hint.block)
        terms.push_back(termOf(hint.expression, state));
    return terms;
  };
}

ExploreOptions Prover::exploreOptions() const {
  ExploreOptions options = isSingleRun_ ? exactOptions() : ExploreOptions();
  options.assumptions = demands_;
  options.demands = [this](const Callee &callee) { return contractsOf(callee) != nullptr; };
  if (!contract())
    return options;
  options.moves = contract()->clearance         ? KeepMoves::WithColumn
                  : hasSpaceClause(*contract()) ? KeepMoves::Yes
                                                : KeepMoves::No;
  options.invariants = [this,
                        hints = hintsOf(contract()->invariants, [this](ExpressionId hint, const SymbolicState &state) {
                          return terms_->condition(hint, entry_, state);
                        })](Place head, const SymbolicState &state) {
    std::vector<TermId> all = hints(head, state);
    const std::vector<TermId> inSpace = space_->hints(state);
    all.insert(all.end(), inSpace.begin(), inSpace.end());
    return all;
  };
  options.measures = hintsOf(contract()->variants, [this](ExpressionId hint, const SymbolicState &state) {
    return terms_->number(hint, entry_, state);
  });
  return options;
}

/// Numbers that the program and its contract write: where its conditions change their outcome.
std::vector<double> Prover::constants() const {
  std::set<double> constants;
  const auto collect = [&](const SyntaxTree &tree) {
    for (const Expression &expression : tree.expressions)
      if (const auto *literal = std::get_if<NumberLiteral>(&expression.node); literal && constants.size() < 24)
        constants.insert(literal->value.toDouble());
  };
  if (contracts_)
    collect(contracts_->tree);
  collect(*file().tree);
  return {constants.begin(), constants.end()};
}

// ---- obligations and their verdicts ----

bool Prover::wanted(ObligationKind kind) const {
  return options_.only.empty() || std::find(options_.only.begin(), options_.only.end(), kind) != options_.only.end();
}

bool Prover::isOwn(Place place) const {
  return place.file == program_.file && file().model->programOf(programs_.node(place).block) == program_.program;
}

/// `O9100.loop-ends.N20`: by the sequence number of the block, or its line.
std::string Prover::idOf(ObligationKind kind, Place place, Span span) const {
  const BlockId block = programs_.node(place).block;
  const std::string program = toString(file().model->programs[program_.program].name);
  for (const SequenceNumber &number : file().model->sequenceNumbersOf(program_.program))
    if (number.block == block)
      return fmt::format("{}.{}.N{}", program, nameOf(kind), number.number);
  return fmt::format("{}.{}.L{}", program, nameOf(kind), file().source->lineOf(span.begin));
}

Obligation &Prover::add(ObligationKind kind, Place place, Span span, std::string claim) {
  Obligation obligation{
      .kind = kind, .id = idOf(kind, place, span), .place = place, .span = span, .claim = std::move(claim)};
  return proof_.obligations.emplace_back(std::move(obligation));
}

Query Prover::onPath(const std::vector<TermId> &conditions, TermId goal) {
  const std::vector<TermId> &facts = reading_.facts();
  facts_.add(facts);
  Query query = relevantQuery(store_, facts_, facts, conditions, goal);
  for (const TermId condition : conditions) { // the path itself may be what is impossible
    const Query part = relevantQuery(store_, facts_, facts, {}, condition);
    query.assumptions.insert(query.assumptions.end(), part.assumptions.begin(), part.assumptions.end());
    query.assumptions.push_back(condition);
  }
  std::sort(query.assumptions.begin(), query.assumptions.end());
  query.assumptions.erase(std::unique(query.assumptions.begin(), query.assumptions.end()), query.assumptions.end());
  return query;
}

void Prover::takeProof(Obligation &obligation, Outcome outcome) {
  const Grade grade = std::get<Proved>(outcome.answer).grade;
  obligation.grade = std::max(obligation.grade.value_or(grade), grade);
  obligation.effort += outcome.effort;
  if (obligation.method.find(outcome.method) == std::string::npos)
    obligation.method += (obligation.method.empty() ? "" : ", ") + outcome.method;
  obligation.evidence.push_back(std::move(outcome));
}

/// By one of the sampled runs, or because paths are missing.
bool Prover::isDecided(Obligation &obligation, const Violation &violation) {
  if (auto witness = witnesses_->amongSamples(violation)) {
    obligation.verdict = Verdict::Refuted;
    obligation.witness = std::move(witness);
    return true;
  }
  if (found_.incomplete)
    obligation.reason = *found_.incomplete;
  return found_.incomplete.has_value();
}

void Prover::decide(Obligation &obligation, const std::vector<Query> &queries, const Violation &violation) {
  if (isSingleRun_)
    return decideSingleRun(obligation, queries);
  if (isDecided(obligation, violation))
    return;
  obligation.verdict = queries.empty() ? Verdict::Unreachable : Verdict::Proved;
  obligation.grade = queries.empty() ? std::optional(Grade::Certified) : std::nullopt;
  for (const Query &query : queries) {
    const Budget left = budget_.without(obligation.effort);
    Outcome outcome = discharge(store_, query, left);
    if (outcome.proved()) {
      takeProof(obligation, std::move(outcome));
      continue;
    }
    obligation.verdict = Verdict::Unknown;
    obligation.effort += outcome.effort;
    if (const smt::Model *model = outcome.counterexample()) {
      if (auto witness = witnesses_->fromModel(*model, violation)) {
        obligation.verdict = Verdict::Refuted;
        obligation.witness = std::move(witness);
        break;
      }
      obligation.reason = "inputs that seem to break it do not do so when they are run";
    } else if (const auto *unknown = std::get_if<Unknown>(&outcome.answer)) {
      obligation.reason = unknown->reason;
    }
    if (left.search == 0)
      break;
  }
  dropProof(obligation);
}

/// Parts of a proof that did not come about.
void Prover::dropProof(Obligation &obligation) {
  if (holds(obligation.verdict))
    return;
  obligation.grade.reset();
  obligation.method.clear();
  obligation.evidence.clear();
}

/// Broken where nothing had to be assumed to come there; more is not asked.
void Prover::decideSingleRun(Obligation &obligation, const std::vector<Query> &queries) const {
  for (const Query &query : queries)
    if (query.goal == store_.no() && std::all_of(query.assumptions.begin(), query.assumptions.end(),
                                                 [&](TermId each) { return each == store_.yes(); }))
      obligation.verdict = Verdict::Refuted;
}

// ---- ends ----

namespace {

/// Leaves out what need not be given, many at once where that will do.
template <typename Suffices> GivenVariables fewest(GivenVariables given, const Suffices &suffices) {
  for (std::size_t size = given.entries().size(); size > 0; size /= 2)
    for (std::size_t first = 0; first < given.entries().size();) {
      GivenVariables fewer;
      for (std::size_t i = 0; i < given.entries().size(); ++i)
        if (i < first || i >= first + size)
          fewer.set(given.entries()[i].first, given.entries()[i].second);
      if (suffices(fewer))
        given = std::move(fewer);
      else
        first += size;
    }
  return given;
}

} // namespace

Termination Prover::endOf(const LoopInstance &loop) {
  Termination end;
  end.endless = endless(loop);
  if (end.endless)
    return end;
  end = provesEnd(reading_, store_, loop);
  if (!end.proved)
    end.endless = endlessFromStart(loop);
  return end;
}

/// The run did not come out of the loop; doubles that have grown too large come to rest in it.
bool Prover::staysIn(const LoopInstance &loop, const RunResult &run) const {
  return (run.end == RunEnd::Fuel || run.end == RunEnd::Repeats) && endsInside(programs_, program_, loop.head, run);
}

/// The loop goes on for ever with these inputs.
bool Prover::goesOn(const LoopInstance &loop, const GivenVariables &given) {
  return recurrenceFrom(reading_, store_, found_, loop, witnesses_->modelOf(given)).has_value();
}

/// Inputs of a sampled run that did not come out of the loop, with which it goes on for ever; as few as will do.
std::optional<Witness> Prover::endless(const LoopInstance &loop) {
  constexpr std::size_t kMostTried = 3;
  std::vector<WitnessSearch::Sample> runs;
  for (const WitnessSearch::Sample &sample : witnesses_->samples())
    if (staysIn(loop, sample.result))
      runs.push_back(sample);
  std::stable_sort(runs.begin(), runs.end(),
                   [](const auto &a, const auto &b) { return a.given.entries().size() < b.given.entries().size(); });
  const auto isEndless = [&](const GivenVariables &given) {
    throwIfStopped();
    RunOptions options = witnesses_->runOptions(given);
    options.fuel = WitnessSearch::kFuel;
    return witnesses_->allowed(given) && staysIn(loop, feedhold::run(programs_, program_, options)) &&
           goesOn(loop, given);
  };
  for (std::size_t i = 0; i < runs.size() && i < kMostTried; ++i)
    if (isEndless(runs[i].given))
      return Witness{fewest(runs[i].given, isEndless), runs[i].result.end,
                     "each pass of the loop leads to another one, for ever"};
  return std::nullopt;
}

/// Inputs with which the loop is met in a state whose pass always leads to one like it.
std::optional<Witness> Prover::endlessFromStart(const LoopInstance &loop) {
  const auto pass = recurrentPass(reading_, store_, loop);
  if (!pass)
    return std::nullopt;
  std::vector<TermId> conditions;
  for (const TermId condition : loop.transitions[*pass].conditions)
    conditions.push_back(smt::substitute(store_, condition, loop.first));
  const Outcome outcome = discharge(store_, onPath(conditions, store_.no()), options_.budget);
  const smt::Model *model = outcome.counterexample();
  if (model == nullptr)
    return std::nullopt;
  auto witness = witnesses_->fromModel(*model, [&](const RunResult &run) -> std::optional<std::string> {
    if (staysIn(loop, run))
      return "each pass of the loop leads to another one like it, for ever";
    return std::nullopt;
  });
  if (witness && witness->end == RunEnd::Fuel && !goesOn(loop, witness->variables))
    return std::nullopt; // made plainer, it may only be long
  return witness;
}

void Prover::settleLoop(Obligation &obligation, const std::vector<const LoopInstance *> &instances,
                        const Violation &violation) {
  if (isOutOfFocus(obligation) || isDecided(obligation, violation))
    return;
  if (found_.treatment == LoopTreatment::EachPass)
    return endsByPasses(obligation);
  obligation.verdict = instances.empty() ? Verdict::Unreachable : Verdict::Proved;
  for (const LoopInstance *instance : instances) {
    if (instance->callsUnknown) {
      obligation.verdict = Verdict::Unknown;
      obligation.reason = "a pass calls a program that is not followed, which need not come back";
      continue;
    }
    const auto known = std::find_if(ends_.begin(), ends_.end(), [&](const auto &end) { return end.first == instance; });
    Termination &end = known != ends_.end() ? known->second : ends_.emplace_back(instance, endOf(*instance)).second;
    if (end.proved) {
      for (const Outcome &outcome : end.evidence)
        takeProof(obligation, outcome);
      continue;
    }
    obligation.verdict = Verdict::Unknown;
    obligation.reason = end.reason;
    if (end.endless) {
      obligation.verdict = Verdict::Refuted;
      obligation.reason.clear();
      obligation.witness = end.endless;
      break;
    }
  }
  if (obligation.verdict == Verdict::Proved && !obligation.grade)
    obligation.grade = Grade::Certified;
  dropProof(obligation);
}

/// When all that lead to the loop say the same.
void Prover::explainEnd(Obligation &obligation, const std::vector<const LoopInstance *> &instances) {
  std::optional<LoopAccount> account;
  for (const auto &[instance, end] : ends_) {
    if (std::find(instances.begin(), instances.end(), instance) == instances.end())
      continue;
    LoopAccount next = accountOf(reading_, programs_, *instance, end);
    if (account && account->why != next.why)
      return;
    if (account && account->bound != next.bound)
      next.bound.clear();
    account = std::move(next);
  }
  if (account) {
    obligation.reason = account->why;
    obligation.bound = account->bound;
  }
}

/// `@CYCLIC`: the program goes round as a whole, in a loop that no other is around.
bool Prover::isMeantToGoOn(const Wto &wto, NodeId head) const {
  if (!contract() || !contract()->cyclic)
    return false;
  return std::none_of(wto.order().begin(), wto.order().end(), [&](NodeId other) {
    return other != head && wto.isHead(other) && wto.positionOf(other) < wto.positionOf(head) &&
           wto.positionOf(head) < wto.endOf(other);
  });
}

void Prover::loops() {
  if (!wanted(ObligationKind::LoopEnds))
    return;
  const Wto wto(file().cfg, *file().model, program_.entry);
  for (const NodeId head : wto.order()) {
    if (!wto.isHead(head) || isMeantToGoOn(wto, head))
      continue;
    const Place place{program_.file, head};
    const auto isInside = [&wto, place](Place at) {
      const std::uint32_t position = at.file == place.file ? wto.positionOf(at.node) : Wto::kUnreachable;
      return wto.positionOf(place.node) <= position && position < wto.endOf(place.node);
    };
    std::vector<const LoopInstance *> instances;
    std::vector<const LoopInstance *> within; // a pass that stays in one of these for ever does not end
    for (const LoopInstance &loop : found_.loops) {
      if (loop.head == place)
        instances.push_back(&loop);
      if (isInside(loop.calls.empty() ? loop.head : loop.calls.front()))
        within.push_back(&loop);
    }
    const Violation violation = [&isInside](const RunResult &run) -> std::optional<std::string> {
      const bool staysInside = !run.circle.empty() && std::all_of(run.circle.begin(), run.circle.end(), isInside);
      if (run.end == RunEnd::Repeats && staysInside)
        return "the run comes back to the same state and goes on for ever";
      return std::nullopt;
    };
    Obligation &obligation =
        add(ObligationKind::LoopEnds, place, file().tree->blocks[programs_.node(place).block].span(), "this loop ends");
    settleLoop(obligation, within, violation);
    if (obligation.verdict == Verdict::Proved)
      explainEnd(obligation, instances);
  }
}

void Prover::programEnds() {
  if (!wanted(ObligationKind::ProgramEnds) || (contract() && contract()->cyclic))
    return;
  const Place place{program_.file, program_.entry};
  std::vector<const LoopInstance *> instances;
  for (const LoopInstance &loop : found_.loops)
    instances.push_back(&loop);
  const Violation violation = [](const RunResult &run) -> std::optional<std::string> {
    if (run.end == RunEnd::Repeats)
      return "the run comes back to the same state and goes on for ever";
    return std::nullopt;
  };
  const BlockId block = programs_.node(place).block;
  Obligation &obligation =
      add(ObligationKind::ProgramEnds, place, file().tree->blocks[block].span(), "the program comes to an end");
  obligation.id = fmt::format("{}.program-ends", toString(file().model->programs[program_.program].name));
  settleLoop(obligation, instances, violation);
  if (!found_.unfollowedCalls.empty() && obligation.verdict != Verdict::Refuted) {
    obligation.verdict = Verdict::Unknown;
    obligation.reason = "a program that is called is not followed and need not come back";
    dropProof(obligation);
  }
  if (instances.empty() && obligation.verdict == Verdict::Unreachable) {
    obligation.verdict = Verdict::Proved;
    obligation.grade = Grade::Certified;
    obligation.method = "no loop";
  }
}

ProgramProof prove(const ProgramSet &programs, Callee program, const FileContracts *contracts,
                   const ProveOptions &options) {
  const smt::Steps steps(options.steps, smt::Steps::AtEnd::GoOn);
  return Prover(programs, program, contracts, options).run();
}

} // namespace feedhold::prove
