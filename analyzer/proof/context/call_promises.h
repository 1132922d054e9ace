// Call promises: the contracts of called programs, for calls whose program is not followed.
#pragma once

#include "proof/context/proof_start.h"

namespace feedhold::prove {

/// All that a proof of the program assumes of the state in which it is entered.
std::vector<smt::TermId> demandsOfCall(smt::TermStore &store, ContractTerms &terms, const Contract &contract,
                                       const SymbolicState &entered, const Dialect &dialect);

/// Refers to both.
CallContracts callContracts(SymbolicInterpretation &interpretation, const ProofSubject &subject);

/// The program, or one that it comes to, calls a program of the files whose contract promises something.
bool callsPromising(const ProofSubject &subject);

} // namespace feedhold::prove
