// Claims that are open after loops were met in the midst of any pass: where all loops have few passes, each pass is
// followed.
#include "proof/prove/prover.h"

#include <algorithm>

namespace feedhold::prove {

namespace {

bool isOpen(const Obligation &obligation) { return obligation.verdict == Verdict::Unknown; }

} // namespace

void Prover::followPasses() {
  const bool hasLoops = !found_.loops.empty() || found_.incomplete;
  if (!hasLoops || !found_.unfollowedCalls.empty() ||
      std::none_of(proof_.obligations.begin(), proof_.obligations.end(), isOpen))
    return;
  ExploreOptions options = exploreOptions();
  options.loops = LoopTreatment::EachPass;
  options.mostSteps = 8'000;
  options.mostPaths = 100;
  options.mostWork = 200'000;
  options.mostTerms = 100'000;
  Exploration each = prove::explore(reading_, programs_, program_, entry_, options);
  if (each.incomplete || !each.unfollowedCalls.empty())
    return;
  found_ = std::move(each);
  ends_.clear();
  open_.clear(); // their queries may be of ways of which some were missing
  proof_.incomplete.reset();
  proof_.unfollowed = found_.unfollowed;
  const std::vector<Obligation> before = std::exchange(proof_.obligations, {});
  settleAll();
  for (Obligation &now : proof_.obligations) {
    const auto known =
        std::find_if(before.begin(), before.end(), [&](const Obligation &old) { return isSameClaim(old, now); });
    if (known != before.end() && !isOpen(*known))
      now = *known;
  }
  for (const Obligation &old : before) // of places that no path comes to
    if (std::none_of(proof_.obligations.begin(), proof_.obligations.end(),
                     [&](const Obligation &now) { return isSameClaim(old, now); }))
      takeUnmet(old);
}

/// All paths have been followed to their end.
void Prover::endsByPasses(Obligation &obligation) const {
  if (!found_.repeats.empty()) {
    obligation.reason = "a path comes back to a state in which it has been";
    return;
  }
  const bool isMet = obligation.kind != ObligationKind::LoopEnds || found_.heads.contains(obligation.place);
  obligation.verdict = isMet ? Verdict::Proved : Verdict::Unreachable;
  obligation.grade = Grade::Certified;
  obligation.method = "each pass";
}

/// No path stops at the place, and all paths have been followed to their end.
void Prover::takeUnmet(Obligation obligation) {
  const bool isStop =
      obligation.kind == ObligationKind::AlarmUnreachable || obligation.kind == ObligationKind::NoControlAlarm;
  if (isOpen(obligation) && isStop) {
    obligation.verdict = Verdict::Unreachable;
    obligation.grade = Grade::Certified;
    obligation.method = "each pass";
    obligation.reason.clear();
  }
  proof_.obligations.push_back(std::move(obligation));
}

} // namespace feedhold::prove
