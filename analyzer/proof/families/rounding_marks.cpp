// Proofs in exact arithmetic, looked at again in that of the control: where a control alarm is proved not to come, and
// the sums that a loop accumulates may be off by so much that it could, the proof holds in exact arithmetic only.
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
  ProveOptions options = context.subject.options;
  options.arithmetic = Arithmetic::Doubles;
  const ProofSubject subject{context.subject.programs, context.subject.program, context.subject.contracts, options};
  ProofStart start(subject);
  ExploreOptions how = start.exploreOptions(subject);
  how.mostWork = 1'000'000;
  how.wholeNumbersAreExact = true;
  const Exploration rounded = explore(start.interpretation(), subject.programs, subject.program, start.entry(), how);
  const Budget budget{.search = options.budget.search, .z3 = 0, .cvc5 = 0};
  for (Obligation &row : rows)
    if (isSensitive(row))
      row.verdict.proved()->exactOnly =
          rounded.incomplete ||
          std::any_of(rounded.stopSites.begin(), rounded.stopSites.end(), [&](const StopSite &stop) {
            return stop.place == row.place && stop.span == row.span && stop.alarm == row.alarm &&
                   !isStillProved(start, stop, budget);
          });
}

} // namespace feedhold::prove
