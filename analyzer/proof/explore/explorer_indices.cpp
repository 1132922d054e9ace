// Indices of which a range is told: relied on while invariants are looked for, and shown on recorded paths.
#include "proof/explore/explorer.h"

namespace feedhold::prove {

using smt::TermId;

namespace {
constexpr std::string_view kIndexOutside = "gave up: an index may be outside of the range that was found for it";
} // namespace

/// By induction over the steps of a run, its first index outside of a range would be one of a step all of whose
/// predecessors were as thought: that step lies on a recorded path.
bool Explorer::mayRelyOn(IndexPlace index, TermId condition) {
  if (result_.unbounded.contains(index))
    return false;
  if (purpose_ == Purpose::Trial) {
    relied_.insert(index);
    return true;
  }
  if (proves(condition))
    return true;
  result_.unbounded.insert(index);
  if (relied_.contains(index))
    giveUp(kIndexOutside);
  return false;
}

/// Ranges of indices are relied on until it turns out that an index may be outside.
Exploration exploreWithRanges(SymbolicInterpretation &interpretation, const ProgramSet &programs, Callee entry,
                              const SymbolicState &start, const ExploreOptions &options, PathMerging merging) {
  constexpr int kMostRounds = 3;
  std::set<IndexPlace> unbounded;
  for (int round = 1;; ++round) {
    Exploration found = Explorer(interpretation, programs, options, merging, unbounded).run(entry, start);
    if (found.incomplete != kIndexOutside || found.isTooLarge)
      return found;
    unbounded = round < kMostRounds ? std::move(found.unbounded) : interpretation.suggestedIndices();
  }
}

} // namespace feedhold::prove
