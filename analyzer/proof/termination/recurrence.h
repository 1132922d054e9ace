// Recurrence sets: proofs that a loop never ends from given inputs (Gupta, Henzinger, Majumdar, Rybalchenko, Xu,
// "Proving non-termination", 2008).
//
// The first iterations are executed exactly.  Of the facts before the later ones, those that every iteration preserves
// are kept: the set is closed.  It is a recurrence set if no state in it can leave the loop: at each branch some
// iteration continues, or one of an inner loop, which either returns or does not end itself.
#pragma once

#include "meaning/machine/machine.h"
#include "proof/decide/discharge.h"
#include "proof/explore/exploration.h"
#include "proof/smt/model.h"

#include <map>
#include <optional>
#include <vector>

namespace feedhold::prove {

struct Recurrence {
  std::vector<smt::TermId> facts; // of the set, over the variables of the loop
  std::size_t stem = 0;           // iterations before the state is in the set
  std::vector<Outcome> evidence;
  std::map<std::uint32_t, double> signals; // that iterations read, and what they are taken to stay
};

/// `inputs`: of every variable of programs whose first value is used.  Signals that the program reads are taken to stay
/// as `signals` says, the others 0.
std::optional<Recurrence> recurrenceFrom(const SymbolicInterpretation &interpretation, smt::TermStore &store,
                                         const Exploration &exploration, const LoopInstance &loop,
                                         const smt::Model &inputs, const std::map<std::uint32_t, double> &signals = {});

/// The run was in an iteration of the loop when it ended.
bool endsInside(const ProgramSet &programs, Callee entry, Place head, const RunResult &run);

} // namespace feedhold::prove
