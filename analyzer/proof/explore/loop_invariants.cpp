// The part of LoopSummarizer that finds invariants: candidates, of which those are kept that each iteration preserves.
#include "proof/decide/entails.h"
#include "proof/explore/explorer.h"
#include "proof/explore/invariant_candidates.h"
#include "proof/explore/loop_work.h"

#include <algorithm>

namespace feedhold::prove {

using smt::Number;
using smt::TermId;

/// Before the first iteration, or some iteration has come before: what let it come back to the head held then.
void LoopSummarizer::addLastIteration(Work &work) {
  smt::TermStore &store = explorer_.store_;
  const smt::Substitution earlier = atIteration(work, -1);
  std::vector<TermId> cases{store.equal(work.iterations, store.number(Number(0)))};
  for (const Path &iteration : work.found) {
    std::vector<TermId> held{store.lessOrEqual(store.number(Number(1)), work.iterations)};
    for (std::size_t i = work.before; i < iteration.conditions.size(); ++i) {
      const auto variables = smt::variablesOf(store, iteration.conditions[i]);
      if (std::all_of(variables.begin(), variables.end(),
                      [&](TermId variable) { return earlier.contains(variable) || isConstant(work, variable); }))
        held.push_back(smt::substitute(store, iteration.conditions[i], earlier));
    }
    cases.push_back(store.logicalAnd(held));
  }
  work.facts.push_back(store.logicalOr(cases));
}

std::vector<TermId> LoopSummarizer::candidates(const Work &work) const {
  LoopTrial trial{work.iterations,          work.shape, work.left,
                  work.arrival.conditions,  {},         explorer_.interpretation_.arithmetic(),
                  explorer_.options_.search};
  for (const Path &iteration : work.found)
    trial.conditions.insert(trial.conditions.end(),
                            iteration.conditions.begin() + static_cast<std::ptrdiff_t>(work.before),
                            iteration.conditions.end());
  std::vector<TermId> all = invariantCandidates(explorer_.store_, trial);
  if (explorer_.options_.invariants)
    for (const TermId hint : explorer_.options_.invariants(work.arrival.at, work.shape.state))
      all.push_back(hint);
  return all;
}

smt::Substitution LoopSummarizer::atArrival(const Work &work) const {
  const TermId zero = explorer_.store_.number(Number(0));
  smt::Substitution first{{work.iterations, zero}};
  for (const Travel &travel : work.shape.travels)
    first.emplace(travel.distance, zero);
  for (const LoopPart &part : work.parts())
    if (part.kind == PartKind::Free)
      first.emplace(part.symbol, part.arrival);
    else if (part.error)
      first.emplace(part.error->now, zero);
  return first;
}

bool LoopSummarizer::holdsAtArrival(const Work &work, TermId candidate) {
  smt::TermStore &store = explorer_.store_;
  const smt::Substitution first = atArrival(work);
  return explorer_.entails_(explorer_.interpretation_.facts(), work.arrival.conditions,
                            smt::substitute(store, candidate, first));
}

/// `also`: conditions on what was before the iteration.
bool LoopSummarizer::holdsAfter(const Work &work, const Path &iteration, TermId candidate,
                                const std::vector<TermId> &also) {
  smt::TermStore &store = explorer_.store_;
  smt::Substitution next = atIteration(work, 1);
  const auto &left = work.left[static_cast<std::size_t>(&iteration - work.found.data())];
  for (std::size_t i = 0; i < work.parts().size(); ++i)
    if (const LoopPart &part = work.parts()[i]; part.kind == PartKind::Free)
      next.emplace(part.symbol, left[i]);
    else if (part.kind == PartKind::Closed && part.error)
      addErrorsBehind(part, left[i], next);
  std::vector<TermId> conditions = iteration.conditions;
  conditions.insert(conditions.end(), also.begin(), also.end());
  return explorer_.entails_(explorer_.interpretation_.facts(), conditions, smt::substitute(store, candidate, next));
}

/// Behind the first iteration, whatever it was: without this it cannot be an invariant of the later ones.
bool LoopSummarizer::holdsAfterFirst(const Work &work, TermId candidate) {
  const TermId isFirst = explorer_.store_.equal(work.iterations, explorer_.store_.number(Number(0)));
  return std::ranges::all_of(work.found,
                             [&](const Path &iteration) { return holdsAfter(work, iteration, candidate, {isFirst}); });
}

/// It speaks of something that iterations change, and of nothing else that is not known before the loop.
bool LoopSummarizer::changesInLoop(const Work &work, TermId candidate) const {
  const smt::Substitution counted = atIteration(work, 1);
  const auto &variables = smt::variablesOf(explorer_.store_, candidate);
  const auto changes = [&](TermId variable) {
    return counted.contains(variable) || std::ranges::any_of(work.parts(), [&](const LoopPart &part) {
             return part.kind == PartKind::Free && part.symbol == variable;
           });
  };
  return std::ranges::any_of(variables, changes) && std::ranges::all_of(variables, [&](TermId variable) {
           return changes(variable) || isConstant(work, variable);
         });
}

/// Houdini: candidates that do not hold are dropped until all that are left hold together.
std::vector<TermId> LoopSummarizer::thoseThatHold(Work &work, const std::vector<TermId> &known,
                                                  std::vector<TermId> candidates) {
  if (candidates.empty())
    return {}; // the facts are as they were tried
  for (int round = 0; round < kMostLoopRounds && !candidates.empty(); ++round) {
    work.facts = known;
    work.facts.insert(work.facts.end(), candidates.begin(), candidates.end());
    bool grew = false;
    if (!tryIterations(work) || !relayout(work, grew) || grew)
      break;
    const auto dropped = std::erase_if(candidates, [&](TermId candidate) {
      return !std::ranges::all_of(work.found,
                                  [&](const Path &iteration) { return holdsAfter(work, iteration, candidate); });
    });
    if (dropped == 0)
      return candidates;
  }
  work.facts = known;
  work.isTried = false;
  return {};
}

/// What does not hold at the arrival may hold once there has been an iteration: a wide search tries that, too.
void LoopSummarizer::addInvariants(Work &work) {
  smt::TermStore &store = explorer_.store_;
  const std::vector<TermId> always = work.facts;
  std::vector<TermId> fromArrival, later;
  for (const TermId candidate : candidates(work))
    if (changesInLoop(work, candidate))
      (holdsAtArrival(work, candidate) ? fromArrival : later).push_back(candidate);
  thoseThatHold(work, always, std::move(fromArrival));
  if (explorer_.options_.search != InvariantSearch::Wide || later.empty())
    return;
  const std::vector<TermId> known = work.facts;
  const TermId isFirst = store.equal(work.iterations, store.number(Number(0)));
  bool grew = false;
  if (!tryIterations(work) || !relayout(work, grew) || grew)
    return;
  std::erase_if(later, [&](TermId candidate) { return !holdsAfterFirst(work, candidate); });
  for (TermId &candidate : later)
    candidate = store.logicalOr(isFirst, candidate);
  thoseThatHold(work, known, std::move(later));
}

} // namespace feedhold::prove
