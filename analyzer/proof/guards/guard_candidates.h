// Guard candidates: conditions on the inputs of which some may make a claim hold.  Guesses: each is proved.
#pragma once

#include "proof/decide/discharge.h"
#include "proof/explore/exploration.h"
#include "proof/guards/guard_atoms.h"

#include <vector>

namespace feedhold::prove {

/// What is not proved, and why it might be so.
struct GuardSubject {
  std::vector<Query> queries = {};              // that failed
  std::vector<const LoopInstance *> loops = {}; // whose end is not proved
};

/// Each once; by rank, then in the order in which the subject speaks of them.
std::vector<GuardAtom> guardCandidates(AtomMaker &make, SymbolicInterpretation &interpretation,
                                       const GuardSubject &subject, const Exploration &found,
                                       const std::vector<double> &constants);

} // namespace feedhold::prove
