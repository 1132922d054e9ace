// What the contract of a program promises.
#include "proof/prove/entails.h"
#include "proof/prove/prover.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::prove {

using smt::Number;
using smt::TermId;

namespace {

const Violation kNothingToReplay{[](const RunResult &) { return std::optional<std::string>(); }};

std::optional<std::string> endOfRun(const RunResult &run) {
  switch (run.end) {
  case RunEnd::M02:
  case RunEnd::M30:
  case RunEnd::Returned:
  case RunEnd::EndOfFile: return "the program ends without an alarm";
  case RunEnd::UserAlarm: return fmt::format("stops with alarm {:.15g}", run.alarmNumber);
  case RunEnd::Alarm: return "the control stops the program";
  case RunEnd::Fuel:
  case RunEnd::Repeats:
  case RunEnd::NotModelled: return std::nullopt;
  }
  return std::nullopt;
}

} // namespace

/// A promise of the contract: whether it is broken is seen from the state, which runs of the machine do not show.
Violation Prover::brokenPromise(const Obligation &obligation) const {
  const auto happened = [kind = obligation.kind](const RunResult &run) {
    auto end = endOfRun(run);
    const bool isStopped = run.end == RunEnd::UserAlarm || run.end == RunEnd::Alarm;
    if (end && kind == ObligationKind::CallMeetsContract)
      return std::optional<std::string>("the call is made with what that contract does not allow");
    if (!end || kind == ObligationKind::AlarmIff)
      return end;
    if (isStopped) // the others are promised of runs that come to their end
      return std::optional<std::string>();
    return std::optional(*end + ", and what was promised does not hold");
  };
  return {happened, [this, claim = obligation.claim, kind = obligation.kind, place = obligation.place](
                        const GivenVariables &given) { return breaksExactly(given, kind, claim, place); }};
}

bool Prover::breaksExactly(const GivenVariables &given, ObligationKind kind, const std::string &claim,
                           Place place) const {
  auto [known, isNew] = brokenExactly_.try_emplace(keyOf(given));
  if (isNew)
    known->second = brokenPromises(given);
  return std::any_of(known->second.begin(), known->second.end(), [&](const Obligation &each) {
    return each.kind == kind && each.claim == claim && each.place == place;
  });
}

/// The program is followed once more, from these inputs alone.
std::vector<Obligation> Prover::brokenPromises(const GivenVariables &given) const {
  ProveOptions options = options_;
  options.only.clear();
  options.guards = InferGuards::No;
  Prover exact(programs_, program_, contracts_, options, given);
  exact.explore();
  exact.promises();
  std::vector<Obligation> all = std::move(exact.proof_.obligations);
  std::erase_if(all, [](const Obligation &each) { return each.verdict != Verdict::Refuted; });
  return all;
}

/// A contract that no call satisfies would make everything true.
void Prover::satisfiable() {
  const Place place{program_.file, program_.entry};
  const Span span = file().tree->blocks[programs_.node(place).block].span();
  if (!anyCall_->proved())
    return;
  Obligation &obligation = add(ObligationKind::ContractSatisfiable, place, span, "some call satisfies this contract");
  obligation.verdict = Verdict::Refuted;
  obligation.reason = "no call satisfies this contract: what it says of the arguments contradicts itself";
  for (Obligation &other : proof_.obligations)
    if (holds(other.verdict)) {
      other.verdict = Verdict::Unknown;
      dropProof(other);
      other.reason = "no call satisfies the contract";
    }
}

void Prover::ensures() {
  for (const Ensure &ensure : contract()->ensures) {
    if (std::holds_alternative<ModalPreserved>(ensure.promise)) {
      modalPreserved(ensure.clause);
      continue;
    }
    if (!wanted(ObligationKind::Ensures))
      continue;
    std::vector<Query> queries;
    for (const PathExit &exit : found_.exits) {
      TermId goal = store_.yes();
      if (const auto *expression = std::get_if<ExpressionId>(&ensure.promise))
        goal = terms_->condition(*expression, entry_, exit.state);
      if (const auto *codes = std::get_if<std::vector<ModalCode>>(&ensure.promise)) {
        const ModalTable modes(*file().dialect);
        for (const ModalCode &code : *codes) {
          const Code *row = code.address == 'G' ? findGCode(*file().dialect, code.tenths) : nullptr;
          const auto index = row ? modes.indexOf(*row) : std::nullopt;
          goal = index ? store_.logicalAnd(
                             goal, store_.equal(exit.state.codes[row->group].index, reading_.code(*index).index))
                       : store_.no();
        }
      }
      queries.push_back(onPath(exit.conditions, goal));
    }
    const Clause &clause = contracts_->clauses[ensure.clause];
    const Place place{program_.file, program_.entry};
    Obligation &obligation =
        add(ObligationKind::Ensures, place, file().tree->blocks[programs_.node(place).block].span(), clause.text);
    settle(obligation, queries, brokenPromise(obligation));
  }
}

void Prover::modalPreserved(ClauseId clause) {
  if (!wanted(ObligationKind::ModalPreserved))
    return;
  std::vector<Query> queries;
  const ModalTable modes(*file().dialect);
  for (const PathExit &exit : found_.exits) {
    TermId same = store_.yes();
    for (std::size_t group = 1; group < kModalGroups; ++group)
      if (!modes.group(group).codes.empty())
        same = store_.logicalAnd(same, store_.equal(exit.state.codes[group].index, entry_.codes[group].index));
    queries.push_back(onPath(exit.conditions, same));
  }
  const Place place{program_.file, program_.entry};
  Obligation &obligation =
      add(ObligationKind::ModalPreserved, place, file().tree->blocks[programs_.node(place).block].span(),
          contracts_->clauses[clause].text);
  settle(obligation, queries, brokenPromise(obligation));
}

void Prover::assigns() {
  if (contract()->assigns.empty() || !wanted(ObligationKind::Assigns))
    return;
  const auto allowed = [&](std::uint32_t variable) {
    for (const Assigns &assigns : contract()->assigns)
      for (const Assigns::Variables &range : assigns.variables)
        if (range.first <= variable && variable <= range.last)
          return true;
    return false;
  };
  std::vector<Query> queries;
  bool unknown = false;
  for (const PathExit &exit : found_.exits) {
    TermId kept = store_.yes();
    for (const auto &[variable, value] : exit.state.variables.entries()) {
      const VariableRange *row = variable < kFirstNamedVariable ? findVariable(*file().dialect, variable) : nullptr;
      if (!row || row->kind == VariableKind::System || row->kind == VariableKind::Local || allowed(variable))
        continue;
      const SymbolicValue before = reading_.atEntry(variable);
      kept = store_.logicalAnd(kept, store_.logicalAnd(store_.equal(value.vacant, before.vacant),
                                                       store_.equal(value.number, before.number)));
    }
    unknown = unknown || !exit.state.forgotten.empty();
    queries.push_back(onPath(exit.conditions, kept));
  }
  const Place place{program_.file, program_.entry};
  Obligation &obligation = add(ObligationKind::Assigns, place, file().tree->blocks[programs_.node(place).block].span(),
                               contracts_->clauses[contract()->assigns.front().clause].text);
  if (unknown)
    obligation.reason = "a variable whose number is not known is written";
  else
    settle(obligation, queries, brokenPromise(obligation));
}

/// Of each entry of a program with a contract: that it satisfies it.
void Prover::callsMeetContracts() {
  if (!wanted(ObligationKind::CallMeetsContract))
    return;
  std::map<std::pair<Place, std::uint32_t>, std::vector<Query>> queries; // by block and callee
  std::map<std::pair<Place, std::uint32_t>, std::string> names;
  for (const CallInstance &call : found_.calls) {
    const FileContracts *contracts = contractsOf(call.callee);
    if (!contracts)
      continue;
    ContractTerms terms(reading_, programs_, call.callee.file, *contracts);
    const Contract &contract = *contracts->of(call.callee.program);
    const TermId met = contract.isSound ? store_.logicalAnd(terms.demandsOfCall(contract, call.state)) : store_.no();
    const auto key = std::pair(call.own, static_cast<std::uint32_t>(call.callee.entry.index()));
    queries[key].push_back(onPath(call.conditions, met));
    names[key] = programName(call.callee);
  }
  for (const auto &[key, parts] : queries) {
    const Place place = key.first;
    Obligation &obligation =
        add(ObligationKind::CallMeetsContract, place, file().tree->blocks[programs_.node(place).block].span(),
            fmt::format("this call satisfies the contract of {}", names[key]));
    settle(obligation, parts, brokenPromise(obligation));
  }
  callsWithoutModalCalls();
}

/// What is proved of a program by itself holds where its movements make no modal call: whoever calls it answers for
/// that.
void Prover::callsWithoutModalCalls() {
  std::map<std::pair<Place, std::string>, std::vector<Query>> queries; // by block and callee
  for (const CallInstance &call : found_.calls)
    if (call.modalCall != store_.no())
      queries[{call.own, programName(call.callee)}].push_back(
          onPath(call.conditions, store_.logicalNot(call.modalCall)));
  for (const auto &[key, parts] : queries) {
    const auto &[place, callee] = key;
    Obligation &obligation =
        add(ObligationKind::CallMeetsContract, place, file().tree->blocks[programs_.node(place).block].span(),
            fmt::format("no modal call is in force when {} is called", callee));
    settle(obligation, parts, kNothingToReplay);
    if (obligation.verdict == Verdict::Unknown)
      obligation.reason =
          fmt::format("the movements of {} call a macro here: its own proofs do not cover that", callee);
  }
}

/// Null: calls of the program need not satisfy anything.
const FileContracts *Prover::contractsOf(const Callee &callee) const {
  const std::size_t index = callee.file.index();
  const FileContracts *contracts = index < options_.contractsOf.size() ? options_.contractsOf[index] : nullptr;
  return contracts && contracts->of(callee.program) ? contracts : nullptr;
}

std::string Prover::programName(const Callee &callee) const {
  return toString(programs_.file(callee.file).model->programs[callee.program].name);
}

/// IF: a call for which the condition holds ends with this alarm and no other way.  IFF: no other call raises it.
void Prover::alarmPromises() {
  if (!wanted(ObligationKind::AlarmIff))
    return;
  for (const AlarmPromise &promise : contract()->alarms) {
    const TermId condition = terms_->condition(promise.condition, entry_, entry_);
    const TermId number = reading_.number(promise.number).number;
    std::vector<Query> queries;
    for (const PathExit &exit : found_.exits)
      queries.push_back(onPath(exit.conditions, store_.logicalNot(condition)));
    for (const Check &check : found_.checks)
      for (const CheckInstance &instance : check.instances) {
        std::vector<TermId> stopped = instance.conditions;
        stopped.push_back(instance.stops);
        const TermId isThis = check.alarm ? store_.no() : store_.equal(instance.number.number, number);
        queries.push_back(onPath(stopped, store_.implies(condition, isThis)));
        if (promise.claim == AlarmClaim::IfAndOnlyIf)
          queries.push_back(onPath(stopped, store_.implies(isThis, condition)));
      }
    for (const UnfollowedCall &call : found_.unfollowedCalls) // which may end with any alarm
      queries.push_back(
          onPath(call.conditions, promise.claim == AlarmClaim::If ? store_.logicalNot(condition) : store_.no()));
    const Place place{program_.file, program_.entry};
    Obligation &obligation =
        add(ObligationKind::AlarmIff, place, file().tree->blocks[programs_.node(place).block].span(),
            contracts_->clauses[promise.clause].text);
    obligation.id =
        fmt::format("{}.alarm-iff.{}", toString(file().model->programs[program_.program].name), promise.number);
    settle(obligation, queries, brokenPromise(obligation));
    requireEnds(obligation);
  }
}

/// What is claimed of all calls is not so of one that goes on for ever.
void Prover::requireEnds(Obligation &obligation) {
  if (obligation.verdict != Verdict::Proved && obligation.verdict != Verdict::Unreachable)
    return;
  if (!found_.repeats.empty()) {
    obligation.verdict = Verdict::Unknown;
    dropProof(obligation);
    obligation.reason = "a path comes back to a state in which it has been";
    return;
  }
  for (const LoopInstance &loop : found_.loops) {
    Obligation ends = obligation;
    settleLoop(ends, {&loop}, kNothingToReplay);
    if (ends.verdict == Verdict::Proved)
      continue;
    obligation.verdict = Verdict::Unknown;
    dropProof(obligation);
    obligation.reason = "it is not known whether a loop ends";
    return;
  }
}

/// Every call that the contract does not allow raises an alarm before an axis moves.
void Prover::guarded() {
  if (!contract()->guarded || !wanted(ObligationKind::Guarded))
    return;
  const Place place{program_.file, program_.entry};
  Obligation &obligation = add(ObligationKind::Guarded, place, file().tree->blocks[programs_.node(place).block].span(),
                               contracts_->clauses[*contract()->guarded].text);
  ExploreOptions options;
  options.assumptions = {store_.logicalNot(store_.logicalAnd(demands_))};
  const Exploration outside = prove::explore(reading_, programs_, program_, entry_, options);
  if (outside.incomplete) {
    obligation.reason = *outside.incomplete;
    return;
  }
  const Exploration inside = std::exchange(found_, outside);
  std::vector<Query> queries;
  for (const PathExit &exit : found_.exits)
    queries.push_back(onPath(exit.conditions, store_.no()));
  for (const Check &check : found_.checks)
    for (const CheckInstance &instance : check.instances) {
      std::vector<TermId> stopped = instance.conditions;
      stopped.push_back(instance.stops);
      queries.push_back(onPath(stopped, store_.logicalNot(instance.moved)));
    }
  for (const UnfollowedCall &call : found_.unfollowedCalls)
    queries.push_back(onPath(call.conditions, store_.no()));
  auto outsideWitnesses =
      std::make_unique<WitnessSearch>(reading_, programs_, program_, options.assumptions, constants());
  start(*outsideWitnesses);
  if (const smt::Model *model = anyCall_->counterexample()) // what breaks one clause may keep the others
    outsideWitnesses->sampleAround(*model);
  const Violation moves{[](const RunResult &run) -> std::optional<std::string> {
    const bool moved = std::any_of(run.moves.begin(), run.moves.end(),
                                   [](const RecordedMove &move) { return move.move.kind != MoveKind::Dwell; });
    if (moved)
      return "an axis moves";
    const bool ended = run.end == RunEnd::M02 || run.end == RunEnd::M30 || run.end == RunEnd::Returned;
    return ended ? std::optional<std::string>("the program ends without an alarm") : std::nullopt;
  }};
  std::swap(witnesses_, outsideWitnesses);
  settle(obligation, queries, moves);
  ends_.clear(); // of the loops of the other exploration
  requireEnds(obligation);
  ends_.clear();
  std::swap(witnesses_, outsideWitnesses);
  found_ = inside;
}

} // namespace feedhold::prove
