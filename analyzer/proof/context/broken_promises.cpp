#include "proof/context/broken_promises.h"

#include "proof/context/proof_context.h"

#include <algorithm>

namespace feedhold::prove {

namespace {

/// Broken where nothing had to be assumed to come there; more is not asked.
bool isBrokenOutright(const smt::TermStore &store, const Question &question) {
  return std::any_of(question.goals.begin(), question.goals.end(), [&](const PathGoal &each) {
    return each.goal == store.no() && each.stops.value_or(store.yes()) == store.yes() &&
           std::all_of(each.conditions->begin(), each.conditions->end(),
                       [&](smt::TermId condition) { return condition == store.yes(); });
  });
}

} // namespace

bool BrokenPromises::breaks(const GivenVariables &given, const Obligation &claim) {
  auto [known, isNew] = known_.try_emplace(keyOf(given));
  if (isNew)
    known->second = follow(given);
  return std::any_of(known->second.begin(), known->second.end(), [&](const Obligation &each) {
    return each.kind == claim.kind && each.claim == claim.claim && each.place == claim.place;
  });
}

/// From these inputs alone.
std::vector<Obligation> BrokenPromises::follow(const GivenVariables &given) const {
  const ProveOptions options{.guards = InferGuards::No, .contractsOf = subject_.options.contractsOf};
  const ProofSubject subject{subject_.programs, subject_.program, subject_.contracts, options};
  ProofStart start(subject, &given);
  const Exploration found = explore(start.reading(), subject.programs, subject.program, start.entry(),
                                    start.exploreOptions(subject, exactOptions()));
  std::vector<Obligation> broken;
  for (Question &question : promisesOf_({subject, start, found}))
    if (question.open.empty() && isBrokenOutright(start.store(), question))
      broken.push_back(std::move(question.row));
  return broken;
}

} // namespace feedhold::prove
