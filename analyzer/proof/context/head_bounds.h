// Between which bounds variables lie before the iterations of loops, as the abstract interpretation has it.
#pragma once

#include "language/contract/contract.h"
#include "proof/explore/exploration.h"

#include <set>

namespace feedhold::prove {

/// Conditions to try as invariants.  Nothing is believed of them: those that every iteration keeps are used.
LoopHints boundsAt(const std::set<Place> &heads, smt::TermStore &store, const ProgramSet &programs, Callee program,
                   const FileContracts *contracts);

} // namespace feedhold::prove
