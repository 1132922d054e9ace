// Guards: conditions on the inputs with which that is proved which is not proved without them.
#include "proof/prove/entails.h"
#include "proof/prove/guard_candidates.h"
#include "proof/prove/guard_fix.h"
#include "proof/prove/guard_search.h"
#include "proof/prove/prover.h"

#include <fmt/format.h>

#include <algorithm>

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
  case ObligationKind::NoControlAlarm: return claim.alarm != AlarmKind::EndOfRecord; // that is for want of an M99
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
/// It goes round within the loop for ever.
bool isInLoop(const Wto &wto, Place head, const RunResult &run) {
  return !run.circle.empty() &&
         std::all_of(run.circle.begin(), run.circle.end(), [&](Place place) { return isInLoop(wto, head, place); });
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

} // namespace

void Prover::settle(Obligation &obligation, const std::vector<Query> &queries, const Violation &violation) {
  if (isOutOfFocus(obligation))
    return;
  decide(obligation, queries, violation);
  if (!focus_ && !holds(obligation.verdict) && mayBeGuarded(obligation))
    open_.push_back({obligation, queries});
}

bool Prover::isOutOfFocus(const Obligation &obligation) const { return focus_ && !isSameClaim(*focus_, obligation); }

/// The conditions that are needed for each claim that is not proved.
void Prover::guards() {
  if (found_.incomplete || (contract() && !contract()->isSound))
    return;
  for (const WitnessSearch::Sample &sample : witnesses_->samples())
    sampleInputs_.push_back(witnesses_->modelOf(sample.given));
  wto_.emplace(file().cfg, *file().model, program_.entry);
  int proofsLeft = kProofsOfAll;
  std::vector<GuardAtom> ofLoops;
  bool allLoopsGuarded = true;
  for (std::size_t i = 0; i < proof_.obligations.size() && proofsLeft > 0 && guardWork_ > 0; ++i) {
    Obligation &claim = proof_.obligations[i];
    if (holds(claim.verdict) || !mayBeGuarded(claim))
      continue;
    const GuardSubject subject = subjectOf(claim);
    const bool isOfLoops = claim.kind == ObligationKind::ProgramEnds; // it ends where each loop does
    if (isOfLoops && !allLoopsGuarded)
      continue;
    std::optional<std::vector<GuardAtom>> atoms;
    if (!isOfLoops || ofLoops.empty())
      atoms = atomsFor(claim, subject, proofsLeft);
    else if (holds(provedWith(claim, subject, conditionOf(ofLoops)).verdict))
      atoms = ofLoops;
    if (claim.kind == ObligationKind::LoopEnds && atoms)
      for (const GuardAtom &atom : *atoms)
        if (std::none_of(ofLoops.begin(), ofLoops.end(), [&](const auto &other) { return other.holds == atom.holds; }))
          ofLoops.push_back(atom);
    allLoopsGuarded = allLoopsGuarded && (atoms || claim.kind != ObligationKind::LoopEnds);
    if (atoms)
      claim.guard = guardOf(claim, *atoms);
  }
}

GuardSubject Prover::subjectOf(const Obligation &claim) const {
  GuardSubject subject;
  for (const OpenClaim &open : open_)
    if (isSameClaim(open.claim, claim))
      subject.queries = open.queries;
  for (const LoopInstance &loop : found_.loops)
    if (claim.kind == ObligationKind::ProgramEnds ||
        (claim.kind == ObligationKind::LoopEnds &&
         isInLoop(*wto_, claim.place, loop.calls.empty() ? loop.head : loop.calls.front())))
      subject.loops.push_back(&loop);
  return subject;
}

Guard Prover::guardOf(const Obligation &claim, const std::vector<GuardAtom> &atoms) const {
  Guard guard{{}, clauseOf(atoms), std::nullopt};
  for (const GuardAtom &atom : atoms)
    guard.conditions.push_back(atom.text);
  if (claim.kind != ObligationKind::AlarmUnreachable) // instead of one alarm another
    guard.fix = guardFix(file(), program_.program, contract(), atoms);
  return guard;
}

/// Guesses, what is left of each guess that was right, and what a wrong one has shown.
std::optional<std::vector<GuardAtom>> Prover::atomsFor(const Obligation &claim, const GuardSubject &subject,
                                                       int &proofsLeft) {
  AtomMaker make(reading_, programs_, *file().dialect);
  GuardSearch search(guardCandidates(make, reading_, subject, found_, constants()));
  const auto show = [&](SampleKind kind, const smt::Model &inputs) {
    std::vector<bool> atoms;
    for (const GuardAtom &atom : search.atoms())
      atoms.push_back(smt::isTrue(store_, atom.holds, inputs));
    search.add(kind, std::move(atoms));
  };
  for (std::size_t i = 0; i < sampleInputs_.size(); ++i)
    show(kindOf(witnesses_->samples()[i].result, claim, *wto_), sampleInputs_[i]);
  if (claim.witness)
    show(SampleKind::Breaks, witnesses_->modelOf(claim.witness->variables));

  if (!subject.loops.empty() && search.neverEnds())
    return std::nullopt; // an alarm that cuts the loop short is no end

  const int allowed = std::min(proofsLeft, subject.loops.empty() ? kProofsOfOne : kProofsOfLoop);
  int proofs = allowed;
  const auto proves = [&](const Conjunction &conjunction) {
    --proofs;
    const Obligation result = provedWith(claim, subject, conditionOf(search.atomsOf(conjunction)));
    if (result.witness)
      show(SampleKind::Breaks, witnesses_->modelOf(result.witness->variables));
    return holds(result.verdict);
  };
  std::optional<Conjunction> best;
  for (int looked = 0; !best && proofs > 0 && guardWork_ > 0 && looked < kMostLooks; ++looked) {
    const auto next = search.next();
    if (!next)
      break;
    if (!isContradiction(conditionOf(search.atomsOf(*next))) && proves(*next))
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
  proofsLeft -= allowed - proofs;
  if (!best || !isPossible(conditionOf(search.atomsOf(*best))))
    return std::nullopt;
  return search.atomsOf(*best);
}

TermId Prover::conditionOf(const std::vector<GuardAtom> &atoms) {
  std::vector<TermId> holds;
  for (const GuardAtom &atom : atoms)
    holds.push_back(atom.holds);
  return store_.logicalAnd(holds);
}

/// No input that the contract allows satisfies the condition: then it would prove anything.
bool Prover::isContradiction(TermId condition) {
  std::vector<TermId> all = demands_;
  all.push_back(condition);
  return discharge(store_, onPath(all, store_.no()), Budget::quick()).proved();
}

/// Some input satisfies the condition, and the contract too.
bool Prover::isPossible(TermId condition) {
  if (std::any_of(sampleInputs_.begin(), sampleInputs_.end(),
                  [&](const smt::Model &inputs) { return smt::isTrue(store_, condition, inputs); }))
    return true;
  std::vector<TermId> all = demands_;
  all.push_back(condition);
  return discharge(store_, onPath(all, store_.no()), kBudget).counterexample() != nullptr;
}

/// The claim under one more assumption: first along the ways that are known, then along those that are left with it.
Obligation Prover::provedWith(const Obligation &claim, const GuardSubject &subject, TermId condition) {
  Obligation result{.kind = claim.kind, .id = claim.id, .place = claim.place, .span = claim.span, .claim = claim.claim};
  const Violation breaks = [&](const RunResult &run) {
    return kindOf(run, claim, *wto_) == SampleKind::Breaks ? std::optional<std::string>("breaks the claim")
                                                           : std::nullopt;
  };
  bool isProved = !subject.queries.empty();
  for (Query query : subject.queries) {
    const Query facts = relevantQuery(store_, found_.facts, {}, condition);
    query.assumptions.insert(query.assumptions.end(), facts.assumptions.begin(), facts.assumptions.end());
    query.assumptions.push_back(condition);
    const Outcome outcome = discharge(store_, query, kBudget);
    guardWork_ -= std::min(guardWork_, outcome.effort);
    isProved = outcome.proved();
    if (const smt::Model *model = outcome.counterexample())
      result.witness = witnesses_->narrowed(condition).fromModel(*model, breaks);
    if (!isProved)
      break;
  }
  if (isProved || result.witness) {
    result.verdict = isProved ? Verdict::Proved : Verdict::Refuted;
    return result;
  }
  if (claim.kind != ObligationKind::AlarmUnreachable && found_.work < guardWork_)
    exploredWith(result, condition);
  return result;
}

void Prover::exploredWith(Obligation &claim, TermId condition) {
  ExploreOptions options = exploreOptions();
  options.assumptions.push_back(condition);
  options.mostWork = guardWork_;
  Exploration found = prove::explore(reading_, programs_, program_, entry_, options);
  const std::uint64_t done = found.work + (claim.kind == ObligationKind::NoControlAlarm ? kWorkOfStop : kWorkOfEnd);
  guardWork_ -= std::min(guardWork_, done);
  auto witnesses = std::make_unique<WitnessSearch>(witnesses_->narrowed(condition));
  std::vector<Obligation> obligations;
  decltype(ends_) ends;
  const auto exchange = [&] {
    std::swap(found_, found);
    std::swap(witnesses_, witnesses);
    std::swap(proof_.obligations, obligations);
    std::swap(ends_, ends);
  };
  exchange();
  focus_ = &claim;
  budget_ = kBudget;
  if (claim.kind == ObligationKind::NoControlAlarm) {
    stops();
    if (!found_.incomplete)
      claim.verdict = Verdict::Unreachable; // unless the place is met
  } else if (claim.kind == ObligationKind::LoopEnds) {
    loops();
  } else if (claim.kind == ObligationKind::ProgramEnds) {
    programEnds();
  } else {
    ensures();
  }
  focus_ = nullptr;
  budget_ = options_.budget;
  exchange();
  for (Obligation &obligation : obligations)
    if (isSameClaim(obligation, claim)) {
      claim.verdict = obligation.verdict;
      claim.witness = std::move(obligation.witness);
    }
}

} // namespace feedhold::prove
