// Recurrence sets: why a loop goes on for ever from given inputs (Gupta, Henzinger, Majumdar, Rybalchenko, Xu, "Proving
// non-termination", 2008).
//
// The first iterations are followed exactly.  Of what holds before the later ones, as much is kept as every iteration
// keeps: the set is closed.  It is a recurrence set when no way out of the loop can be taken from it: at each branch
// that the iterations come to, some iteration goes on, or one of a loop within, which either comes back or does not end
// itself.
#pragma once

#include "meaning/machine/machine.h"
#include "proof/decide/discharge.h"
#include "proof/explore/exploration.h"
#include "proof/smt/model.h"

#include <optional>
#include <vector>

namespace feedhold::prove {

struct Recurrence {
  std::vector<smt::TermId> facts; // of the set, over the variables of the loop
  std::size_t stem = 0;           // iterations before the state is in the set
  std::vector<Outcome> evidence;
};

/// `inputs`: of every variable of programs whose first value is used.  Signals that the program reads are taken to stay
/// 0.
std::optional<Recurrence> recurrenceFrom(const SymbolicInterpretation &reading, smt::TermStore &store,
                                         const Exploration &exploration, const LoopInstance &loop,
                                         const smt::Model &inputs);

/// The run was in an iteration of the loop when it ended.
bool endsInside(const ProgramSet &programs, Callee entry, Place head, const RunResult &run);

} // namespace feedhold::prove
