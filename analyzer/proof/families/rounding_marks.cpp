// Proofs are over exact numbers; controls add in floating point.  Where a sum that a loop accumulates may be off by a
// little and the control could then stop, the proof holds in exact arithmetic only.
#include "proof/families/families.h"

#include <algorithm>

namespace feedhold::prove {

namespace {

bool isSensitive(const Obligation &obligation) {
  return obligation.kind == ObligationKind::NoControlAlarm && obligation.verdict == Verdict::Proved;
}

bool isStillProved(ProofStart &start, const StopSite &stop, const Budget &budget) {
  smt::TermStore &store = start.store();
  return std::all_of(stop.instances.begin(), stop.instances.end(), [&](const StopInstance &instance) {
    return discharge(store, start.onPath(instance.conditions, store.logicalNot(instance.stops)), budget).proved();
  });
}

} // namespace

void markRounding(const ProofContext &context, std::vector<Obligation> &rows) {
  if (context.found.loops.empty() || std::none_of(rows.begin(), rows.end(), isSensitive))
    return;
  const ProofSubject &subject = context.subject;
  ExploreOptions options = context.start.exploreOptions(subject);
  options.sums = Sums::Rounded;
  const Exploration rounded =
      explore(context.start.interpretation(), subject.programs, subject.program, context.start.entry(), options);
  if (rounded.incomplete)
    return;
  const Budget budget{.search = subject.options.budget.search, .z3 = 0, .cvc5 = 0};
  for (Obligation &row : rows)
    if (isSensitive(row))
      row.verdict.proved()->exactOnly =
          std::any_of(rounded.stopSites.begin(), rounded.stopSites.end(), [&](const StopSite &stop) {
            return stop.place == row.place && stop.span == row.span && stop.alarm == row.alarm &&
                   !isStillProved(context.start, stop, budget);
          });
}

} // namespace feedhold::prove
