// `@ENSURE MODAL PRESERVED`: what the modal state contains (docs/contracts.md), and whether a program leaves it as it
// was.
#pragma once

#include "proof/context/proof_context.h"

namespace feedhold::prove {

/// The modal state is that of the entry, but for the words of the addresses that the clause excepts.
smt::TermId modalStateKept(const ExploredProgram &program, const ModalPreserved &clause, const SymbolicState &state);
/// A mode that is not compared and that some code of the program may set, by its code; absent: it has no such code.
std::optional<std::string> modeNotTold(const ExploredProgram &program);
/// Which parts of it are not seen to be kept on some path, in shop words; empty: all of them are.
std::string whyNotKept(const ExploredProgram &program, const ModalPreserved &clause);

} // namespace feedhold::prove
