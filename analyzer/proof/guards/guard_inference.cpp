// Searches conditions on the inputs under which an open or refuted claim is proved.
#include "proof/guards/guard_inference.h"

#include "language/dialect/code_name.h"
#include "meaning/cfg/wto.h"
#include "proof/families/families.h"
#include "proof/guards/guard_candidates.h"
#include "proof/guards/guard_fix.h"
#include "proof/guards/guard_search.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace feedhold::prove {

using smt::TermId;

namespace {

constexpr int kProofsOfOne = 8;
constexpr int kProofsOfLoop = 4; // each of which takes much longer
constexpr int kProofsOfAll = 40;
constexpr int kMostLooks = 60;
/// What settling a claim may take, in units of the exploration.
constexpr std::uint64_t kWorkOfStop = 20'000;
constexpr std::uint64_t kWorkOfEnd = 100'000;
constexpr Budget kBudget{
    .search = 150'000, .z3 = 0, .cvc5 = 0}; // what needs a solver is seldom guarded by a simple condition

/// Claims about what single runs come to; of the others a condition on the inputs is no remedy.
bool mayBeGuarded(const Obligation &claim) {
  switch (claim.kind) {
  case ObligationKind::LoopEnds:
  case ObligationKind::ProgramEnds:
  case ObligationKind::AlarmUnreachable:
  case ObligationKind::Ensures: return true;
  case ObligationKind::NoControlAlarm: // an M99 is missing, or a program: no argument mends that; or it is not proved
    return claim.alarm != AlarmKind::EndOfRecord && claim.alarm != AlarmKind::ProgramNotFound;
  case ObligationKind::Compensation:
  case ObligationKind::AlarmIff:
  case ObligationKind::Assigns:
  case ObligationKind::ModalPreserved:
  case ObligationKind::Guarded:
  case ObligationKind::CallMeetsContract:
  case ObligationKind::ContractSatisfiable:
  case ObligationKind::KeepIn:
  case ObligationKind::KeepOut:
  case ObligationKind::Clearance:
  case ObligationKind::Travel:
  case ObligationKind::Limit: return false;
  }
  return false;
}

bool isInLoop(const Wto &wto, Place head, Place place) {
  const std::uint32_t position = place.file == head.file ? wto.positionOf(place.node) : Wto::kUnreachable;
  return wto.positionOf(head.node) <= position && position < wto.endOf(head.node);
}
/// The run repeats for ever within the loop.
bool isInLoop(const Wto &wto, Place head, const RunResult &run) {
  return !run.cycle.empty() &&
         std::all_of(run.cycle.begin(), run.cycle.end(), [&](Place place) { return isInLoop(wto, head, place); });
}

SampleKind kindOf(const RunResult &run, const Obligation &claim, const Wto &wto) {
  const bool isHere = run.place == claim.place && run.alarmSpan == claim.span;
  if (run.end == RunEnd::Fuel) // perhaps it is long
    return SampleKind::Other;
  if (run.end == RunEnd::Repeats)
    return claim.kind == ObligationKind::ProgramEnds ||
                   (claim.kind == ObligationKind::LoopEnds && isInLoop(wto, claim.place, run))
               ? SampleKind::Breaks
               : SampleKind::Other;
  if (run.end == RunEnd::UserAlarm)
    return claim.kind == ObligationKind::AlarmUnreachable && isHere ? SampleKind::Breaks : SampleKind::Other;
  if (run.end == RunEnd::Alarm && run.alarm == AlarmKind::EndOfRecord)
    return SampleKind::Ends;
  if (run.end == RunEnd::Alarm)
    return claim.kind == ObligationKind::NoControlAlarm && isHere && run.alarm == claim.alarm ? SampleKind::Breaks
                                                                                              : SampleKind::Other;
  return SampleKind::Ends;
}

std::string clauseOf(const std::vector<GuardAtom> &atoms) {
  std::string text;
  for (const GuardAtom &atom : atoms)
    text += atoms.size() == 1 ? atom.text : fmt::format("{}[{}]", text.empty() ? "" : " AND ", atom.text);
  return "@REQUIRE " + text;
}

/// `@MODAL G17 G90`
Guard modalGuard(const ModalTable &modes, const std::map<std::uint8_t, std::uint8_t> &codes) {
  Guard guard;
  guard.clause = "@MODAL";
  for (const auto &[group, code] : codes) {
    const std::string name = codeName('G', modes.group(group).codes[code]->tenths);
    guard.conditions.push_back(name + " at the start");
    guard.clause += " " + name;
  }
  return guard;
}

/// What became of a claim under one more assumption.
struct Trial {
  bool holds = false;
  std::optional<Witness> witness = {};

  static Trial of(const Obligation &row) {
    const Witness *witness = row.verdict.witness();
    return {row.verdict.holds(), witness ? std::optional(*witness) : std::nullopt};
  }
};

class GuardInference {
public:
  GuardInference(const ProofContext &context, const std::vector<Question> &open)
      : context_(context), start_(context.start), store_(context.start.store()), open_(open),
        wto_(context.subject.file().cfg, *context.subject.file().model, context.subject.program.entry) {
    for (const WitnessSearch::Sample &sample : context.witnesses.samples())
      sampleInputs_.push_back(context.witnesses.modelOf(sample.given));
  }

  void addTo(std::vector<Obligation> &rows);

private:
  using Atoms = std::vector<GuardAtom>;
  std::optional<Atoms> atomsOfEnd(const Obligation &claim, const GuardSubject &subject);
  GuardSubject subjectOf(const Obligation &claim);
  Guard guardOf(const Obligation &claim, const Atoms &atoms) const;
  std::optional<Guard> modalGuardFor(const Obligation &claim, const GuardSubject &subject);
  TermId inModes(const std::map<std::uint8_t, std::uint8_t> &codes);
  std::optional<Atoms> atomsFor(const Obligation &claim, const GuardSubject &subject);
  void showSamples(GuardSearch &search, const Obligation &claim) const;
  void show(GuardSearch &search, SampleKind kind, const smt::Model &inputs) const;
  std::optional<Conjunction> weakest(GuardSearch &search, const std::function<bool(const Conjunction &)> &proves,
                                     const int &proofs);
  TermId conditionOf(const Atoms &atoms);
  Outcome anyCallWith(TermId condition, const Budget &budget);
  bool isPossible(TermId condition);
  Trial provedWith(const Obligation &claim, const GuardSubject &subject, TermId condition);
  Trial alongKnownPaths(const Obligation &claim, const GuardSubject &subject, TermId condition);
  Trial exploredWith(const Obligation &claim, TermId condition);
  Trial settledIn(const ProofContext &context, const Obligation &claim) const;

  const ProofContext &context_;
  ProofStart &start_;
  smt::TermStore &store_;
  const std::vector<Question> &open_;
  Wto wto_;
  std::vector<smt::Model> sampleInputs_;
  std::uint64_t work_ = 2'000'000; // of explorations under conditions
  int proofsLeft_ = kProofsOfAll;
  Atoms ofLoops_; // all conditions that loops need to end
  bool areAllLoopsGuarded_ = true;
};

void GuardInference::addTo(std::vector<Obligation> &rows) {
  for (Obligation &claim : rows) {
    if (proofsLeft_ <= 0 || work_ == 0)
      return;
    if (claim.verdict.holds() || !mayBeGuarded(claim))
      continue;
    const GuardSubject subject = subjectOf(claim);
    if (auto guard = modalGuardFor(claim, subject)) {
      claim.verdict.setGuard(*std::move(guard));
      continue;
    }
    const auto atoms =
        claim.kind == ObligationKind::ProgramEnds ? atomsOfEnd(claim, subject) : atomsFor(claim, subject);
    if (claim.kind == ObligationKind::LoopEnds) {
      for (const GuardAtom &atom : atoms.value_or(Atoms()))
        if (std::none_of(ofLoops_.begin(), ofLoops_.end(),
                         [&](const GuardAtom &other) { return other.holds == atom.holds; }))
          ofLoops_.push_back(atom);
      areAllLoopsGuarded_ = areAllLoopsGuarded_ && atoms;
    }
    if (atoms)
      claim.verdict.setGuard(guardOf(claim, *atoms));
  }
}

TermId GuardInference::inModes(const std::map<std::uint8_t, std::uint8_t> &codes) {
  std::vector<TermId> holds;
  for (const auto &[group, code] : codes)
    holds.push_back(
        store_.equal(start_.entry().codes[group].index, store_.number(smt::Number(static_cast<int>(code)))));
  return store_.logicalAnd(holds);
}

/// The claim is broken from a start in other modes than those of power-on: whether it holds in those.
std::optional<Guard> GuardInference::modalGuardFor(const Obligation &claim, const GuardSubject &subject) {
  constexpr int kMostModes = 4;
  const Witness *first = claim.verdict.witness();
  std::optional<GivenStart> broken = first ? std::optional(first->variables.start) : std::nullopt;
  const ModalTable modes(context_.subject.dialect());
  std::map<std::uint8_t, std::uint8_t> wanted;
  for (int step = 0; step < kMostModes && broken && !broken->codes.empty() && proofsLeft_ > 0; ++step) {
    const std::size_t before = wanted.size();
    for (const auto &[group, code] : broken->codes)
      if (const auto usual = modes.powerOn(group))
        wanted.emplace(group, *usual);
    if (wanted.size() == before)
      break;
    --proofsLeft_;
    const TermId condition = inModes(wanted);
    const Trial trial = provedWith(claim, subject, condition);
    if (trial.holds && isPossible(condition))
      return modalGuard(modes, wanted);
    broken = trial.witness ? std::optional(trial.witness->variables.start) : std::nullopt;
  }
  return std::nullopt;
}

/// The program ends where each loop does.
std::optional<GuardInference::Atoms> GuardInference::atomsOfEnd(const Obligation &claim, const GuardSubject &subject) {
  if (!areAllLoopsGuarded_)
    return std::nullopt;
  if (ofLoops_.empty())
    return atomsFor(claim, subject);
  return provedWith(claim, subject, conditionOf(ofLoops_)).holds ? std::optional(ofLoops_) : std::nullopt;
}

GuardSubject GuardInference::subjectOf(const Obligation &claim) {
  GuardSubject subject;
  for (const Question &open : open_)
    if (isSameClaim(open.row, claim))
      subject.queries = queriesOf(start_, open);
  for (const LoopInstance &loop : context_.found.loops)
    if (claim.kind == ObligationKind::ProgramEnds ||
        (claim.kind == ObligationKind::LoopEnds &&
         isInLoop(wto_, claim.place, loop.calls.empty() ? loop.head : loop.calls.front())))
      subject.loops.push_back(&loop);
  return subject;
}

Guard GuardInference::guardOf(const Obligation &claim, const Atoms &atoms) const {
  const ProofSubject &subject = context_.subject;
  Guard guard{{}, clauseOf(atoms), std::nullopt};
  for (const GuardAtom &atom : atoms)
    guard.conditions.push_back(atom.text);
  if (claim.kind != ObligationKind::AlarmUnreachable) // instead of one alarm another
    guard.fix = guardFix(subject.file(), subject.program.program, subject.contract(), atoms);
  return guard;
}

void GuardInference::show(GuardSearch &search, SampleKind kind, const smt::Model &inputs) const {
  std::vector<bool> atoms;
  for (const GuardAtom &atom : search.atoms())
    atoms.push_back(smt::isTrue(store_, atom.holds, inputs));
  search.add(kind, std::move(atoms));
}

void GuardInference::showSamples(GuardSearch &search, const Obligation &claim) const {
  for (std::size_t i = 0; i < sampleInputs_.size(); ++i)
    show(search, kindOf(context_.witnesses.samples()[i].result, claim, wto_), sampleInputs_[i]);
  if (const Witness *witness = claim.verdict.witness())
    show(search, SampleKind::Breaks, context_.witnesses.modelOf(witness->variables));
}

/// Guesses, what is left of each guess that was right, and what a wrong one has shown.
std::optional<GuardInference::Atoms> GuardInference::atomsFor(const Obligation &claim, const GuardSubject &subject) {
  AtomMaker make(start_.interpretation(), context_.subject.programs, context_.subject.dialect());
  GuardSearch search(
      guardCandidates(make, start_.interpretation(), subject, context_.found, context_.subject.constants()));
  showSamples(search, claim);
  if (!subject.loops.empty() && search.neverEnds())
    return std::nullopt; // an alarm that cuts the loop short is no end

  const int allowed = std::min(proofsLeft_, subject.loops.empty() ? kProofsOfOne : kProofsOfLoop);
  int proofs = allowed;
  const auto proves = [&](const Conjunction &conjunction) {
    --proofs;
    const Trial trial = provedWith(claim, subject, conditionOf(search.atomsOf(conjunction)));
    if (trial.witness)
      show(search, SampleKind::Breaks, context_.witnesses.modelOf(trial.witness->variables));
    return trial.holds;
  };
  const std::optional<Conjunction> best = weakest(search, proves, proofs);
  proofsLeft_ -= allowed - proofs;
  if (!best || !isPossible(conditionOf(search.atomsOf(*best))))
    return std::nullopt;
  return search.atomsOf(*best);
}

std::optional<Conjunction> GuardInference::weakest(GuardSearch &search,
                                                   const std::function<bool(const Conjunction &)> &proves,
                                                   const int &proofs) {
  std::optional<Conjunction> best;
  for (int looked = 0; !best && proofs > 0 && work_ > 0 && looked < kMostLooks; ++looked) {
    const auto next = search.next();
    if (!next)
      break;
    // What no call satisfies would prove anything.
    if (!anyCallWith(conditionOf(search.atomsOf(*next)), Budget::quick()).proved() && proves(*next))
      best = next;
  }
  for (bool isWeaker = best.has_value(); isWeaker;) {
    isWeaker = false;
    for (const Conjunction &next : search.weaker(*best)) {
      if (isWeaker || proofs == 0)
        break;
      search.tried(next);
      isWeaker = proves(next);
      if (isWeaker)
        best = next;
    }
  }
  return best;
}

TermId GuardInference::conditionOf(const Atoms &atoms) {
  std::vector<TermId> holds;
  for (const GuardAtom &atom : atoms)
    holds.push_back(atom.holds);
  return store_.logicalAnd(holds);
}

/// Proved: no input that the contract allows satisfies the condition.  The counterexample is one that does.
Outcome GuardInference::anyCallWith(TermId condition, const Budget &budget) {
  std::vector<TermId> all = start_.demands();
  all.push_back(condition);
  return discharge(store_, start_.onPath(all, store_.no()), budget);
}

/// Some input satisfies the condition, and the contract too.
bool GuardInference::isPossible(TermId condition) {
  return std::any_of(sampleInputs_.begin(), sampleInputs_.end(),
                     [&](const smt::Model &inputs) { return smt::isTrue(store_, condition, inputs); }) ||
         anyCallWith(condition, kBudget).counterexample() != nullptr;
}

/// First along the paths that are known, then along those that are left with the condition.
Trial GuardInference::provedWith(const Obligation &claim, const GuardSubject &subject, TermId condition) {
  Trial trial = alongKnownPaths(claim, subject, condition);
  const bool isDecided = trial.holds || trial.witness;
  if (!isDecided && claim.kind != ObligationKind::AlarmUnreachable && context_.found.work < work_)
    return exploredWith(claim, condition);
  return trial;
}

Trial GuardInference::alongKnownPaths(const Obligation &claim, const GuardSubject &subject, TermId condition) {
  const Violation breaks = [&](const RunResult &run) {
    return kindOf(run, claim, wto_) == SampleKind::Breaks ? std::optional<std::string>("breaks the claim")
                                                          : std::nullopt;
  };
  Trial trial{.holds = !subject.queries.empty()};
  for (Query query : subject.queries) {
    const Query facts = relevantQuery(store_, context_.found.facts, {}, condition);
    query.assumptions.insert(query.assumptions.end(), facts.assumptions.begin(), facts.assumptions.end());
    query.assumptions.push_back(condition);
    const Outcome outcome = discharge(store_, query, kBudget);
    work_ -= std::min(work_, outcome.effort);
    trial.holds = outcome.proved();
    if (const smt::Model *model = outcome.counterexample())
      trial.witness = context_.witnesses.narrowed(condition, {}).fromModel(*model, breaks);
    if (!trial.holds)
      break;
  }
  return trial;
}

Trial GuardInference::exploredWith(const Obligation &claim, TermId condition) {
  const ProofSubject &subject = context_.subject;
  ExploreOptions options = start_.exploreOptions(subject);
  options.assumptions.push_back(condition);
  options.relyOn = Reliance::Nobody; // a guard does not say with what it is proved
  options.mostWork = work_;
  const Exploration found =
      explore(start_.interpretation(), subject.programs, subject.program, start_.entry(), options);
  const std::uint64_t done = found.work + (claim.kind == ObligationKind::NoControlAlarm ? kWorkOfStop : kWorkOfEnd);
  work_ -= std::min(work_, done);
  const WitnessSearch witnesses = context_.witnesses.narrowed(condition, sampleInputs_);
  LoopEnds ends;
  return settledIn({{subject, start_, found}, witnesses, context_.promises, ends, context_.anyCall, kBudget}, claim);
}

/// The one claim, and no other.
Trial GuardInference::settledIn(const ProofContext &context, const Obligation &claim) const {
  if (claim.kind == ObligationKind::LoopEnds)
    return Trial::of(loopRow(context, claim.place));
  if (claim.kind == ObligationKind::ProgramEnds)
    return Trial::of(*programEndRow(context));
  const bool isStop = claim.kind == ObligationKind::NoControlAlarm;
  for (const Question &question : isStop ? stopQuestions(context) : ensureQuestions(context))
    if (isSameClaim(question.row, claim))
      return Trial::of(settle(context, question));
  return {.holds = isStop && !context.found.incomplete}; // the place is not met
}

} // namespace

void addGuards(const ProofContext &context, const std::vector<Question> &open, std::vector<Obligation> &rows) {
  const Contract *contract = context.subject.contract();
  if (context.found.incomplete || (contract && !contract->isSound))
    return;
  GuardInference(context, open).addTo(rows);
}

} // namespace feedhold::prove
