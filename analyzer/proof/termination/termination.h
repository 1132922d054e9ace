// Termination: why a loop comes to its end.
//
// A measure of the state that every pass lowers by at least a positive amount that no pass changes, and that is not
// negative before a pass, allows finitely many passes.  Several measures are taken in lexicographic order (Bradley,
// Manna, Sipma, "Linear ranking with reachability", 2005), and passes that cannot follow one another in a circle are
// set aside first.
#pragma once

#include "proof/decide/discharge.h"
#include "proof/explore/exploration.h"
#include "proof/obligation/obligation.h"

namespace feedhold::prove {

/// One measure and the passes (by number) that lower it.
struct Measure {
  smt::TermId measure;
  smt::TermId decrease; // of the first of its passes
  std::vector<std::size_t> passes;
  bool isLate = false; // lowered only from some pass on
};

struct Termination {
  bool proved = false;
  std::vector<Measure> measures; // in lexicographic order
  std::vector<Outcome> evidence;
  std::string reason;                  // why not
  std::optional<Witness> endless = {}; // inputs with which it goes on for ever
};

Termination provesEnd(const SymbolicReading &reading, smt::TermStore &store, const LoopInstance &loop);

/// A pass that always leads to one like it: its conditions hold again behind it.  The number of that pass.
std::optional<std::size_t> recurrentPass(const SymbolicReading &reading, smt::TermStore &store,
                                         const LoopInstance &loop);

} // namespace feedhold::prove
