// Invariant candidates: relations that may hold before every iteration of a loop, guessed from its trial iterations.  A
// guess costs time and nothing else: loops.h keeps those that are proved.
#pragma once

#include "proof/explore/exploration.h"
#include "proof/explore/loops.h"

namespace feedhold::prove {

/// What trial iterations of a loop have shown.
struct LoopTrial {
  smt::TermId iterations;
  const LoopShape &shape;
  const std::vector<std::vector<smt::TermId>> &left; // by iteration: what it leaves in each part
  std::vector<smt::TermId> arrival;                  // conditions of the path that met the loop
  std::vector<smt::TermId> conditions;               // of all iterations
  Arithmetic arithmetic = Arithmetic::Exact;
  InvariantSearch search = InvariantSearch::Usual;
};

/// Each once, in ascending order.
std::vector<smt::TermId> invariantCandidates(smt::TermStore &store, const LoopTrial &trial);

} // namespace feedhold::prove
