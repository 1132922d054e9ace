// Modal parts: what of a state belongs to the modal state of a contract (docs/contracts.md).
#pragma once

#include "language/contract/contract.h"
#include "proof/symbolic/symbolic_interpretation.h"

#include <string>
#include <vector>

namespace feedhold::prove {

/// In the words of the manual; empty for parts that are not of the modal state.
std::string nameOfPart(PartId id);

/// A part of the modal state, and under which condition it is as it was before.
struct ModalPart {
  PartId id;
  smt::TermId isKept;
};
/// All that the clause speaks of.
std::vector<ModalPart> modalParts(SymbolicInterpretation &interpretation, const Dialect &dialect,
                                  const ModalPreserved &clause, SymbolicState before, SymbolicState now);

/// Behind a program that keeps the clause: what it speaks of is as before.  A coordinate that waits for its axis to be
/// named goes with the position and is left as it is.
void keepModalState(SymbolicInterpretation &interpretation, const Dialect &dialect, const ModalPreserved &clause,
                    SymbolicState before, SymbolicState &now);

} // namespace feedhold::prove
