// Proofs are over exact numbers; controls add in floating point.  Where a sum that a loop accumulates may be off by a
// little and the control could then stop, the proof holds in exact arithmetic only.
#include "proof/prove/prover.h"

#include <algorithm>

namespace feedhold::prove {

namespace {

bool isSensitive(const Obligation &obligation) {
  return obligation.kind == ObligationKind::NoControlAlarm && obligation.verdict == Verdict::Proved;
}

} // namespace

void Prover::checkRounding() {
  std::vector<Obligation> &all = proof_.obligations;
  if (found_.loops.empty() || std::none_of(all.begin(), all.end(), isSensitive))
    return;
  ExploreOptions options = exploreOptions();
  options.sums = Sums::Rounded;
  Exploration rounded = prove::explore(reading_, programs_, program_, entry_, options);
  if (rounded.incomplete)
    return;
  std::swap(found_, rounded);
  for (Obligation &obligation : all)
    if (isSensitive(obligation))
      obligation.exactOnly = std::any_of(found_.checks.begin(), found_.checks.end(), [&](const Check &check) {
        return check.place == obligation.place && check.span == obligation.span && check.alarm == obligation.alarm &&
               !isStillProved(check);
      });
  std::swap(found_, rounded);
}

bool Prover::isStillProved(const Check &check) {
  return std::all_of(check.instances.begin(), check.instances.end(), [&](const CheckInstance &instance) {
    const Budget budget{.search = options_.budget.search, .z3 = 0, .cvc5 = 0};
    return discharge(store_, onPath(instance.conditions, store_.logicalNot(instance.stops)), budget).proved();
  });
}

} // namespace feedhold::prove
