// Termination: why a loop comes to its end.
//
// A measure of the state that every iteration lowers by at least a positive amount that no iteration changes, and that
// is not negative before an iteration, allows finitely many iterations.  Several measures are taken in lexicographic
// order (Bradley, Manna, Sipma, "Linear ranking with reachability", 2005), and iterations that cannot follow one
// another in a circle are set aside first.
#pragma once

#include "proof/decide/discharge.h"
#include "proof/explore/exploration.h"
#include "proof/obligation/obligation.h"

namespace feedhold::prove {

/// One measure and the iterations (by number) that lower it.
struct RankingFunction {
  smt::TermId measure;
  smt::TermId decrease; // of the first of its iterations
  std::vector<std::size_t> iterations;
  bool isLate = false; // lowered only from some iteration on
};

struct Termination {
  bool proved = false;
  std::vector<RankingFunction> measures; // in lexicographic order
  std::vector<Outcome> evidence;
  std::string reason;                  // why not
  std::optional<Witness> endless = {}; // inputs with which it goes on for ever
};

Termination provesEnd(const SymbolicInterpretation &reading, smt::TermStore &store, const LoopInstance &loop);

/// An iteration that always leads to one like it: its conditions hold again behind it.  The number of that iteration.
std::optional<std::size_t> recurrentIteration(const SymbolicInterpretation &reading, smt::TermStore &store,
                                              const LoopInstance &loop);

} // namespace feedhold::prove
