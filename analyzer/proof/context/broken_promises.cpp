#include "proof/context/broken_promises.h"

#include "proof/context/followed_run.h"

#include <algorithm>

namespace feedhold::prove {

namespace {

/// The goal that fails on a path without conditions, if any; other paths may be infeasible.
const PathGoal *brokenOutright(const smt::TermStore &store, const Question &question) {
  const auto found = std::find_if(question.goals.begin(), question.goals.end(), [&](const PathGoal &each) {
    return each.goal == store.no() && each.stops.value_or(store.yes()) == store.yes() &&
           std::all_of(each.conditions->begin(), each.conditions->end(),
                       [&](smt::TermId condition) { return condition == store.yes(); });
  });
  return found == question.goals.end() ? nullptr : &*found;
}

} // namespace

std::string BrokenPromises::howBroken(const GivenVariables &given, const Obligation &claim) {
  const Broken *found = broken(given, claim);
  return found ? found->how : std::string();
}

const BrokenPromises::Broken *BrokenPromises::broken(const GivenVariables &given, const Obligation &claim) {
  auto [known, isNew] = known_.try_emplace(keyOf(given));
  if (isNew)
    known->second = follow(given);
  const auto found = std::find_if(known->second.begin(), known->second.end(), [&](const Broken &each) {
    return each.claim.kind == claim.kind && each.claim.claim == claim.claim && each.claim.place == claim.place;
  });
  return found == known->second.end() ? nullptr : &*found;
}

/// From these inputs alone.
std::vector<BrokenPromises::Broken> BrokenPromises::follow(const GivenVariables &given) const {
  FollowedRun run(subject_, given, subject_.options.arithmetic, Outcomes::All);
  std::vector<Broken> broken;
  for (Question &question : promisesOf_(run.program()))
    if (const PathGoal *goal = question.open.empty() ? brokenOutright(run.store(), question) : nullptr)
      broken.push_back({std::move(question.row), goal->missedBy});
  return broken;
}

} // namespace feedhold::prove
