// Call promises: the contracts of called programs, for calls whose program is not followed.
#pragma once

#include "proof/context/proof_start.h"

namespace feedhold::prove {

/// What the contract demands of the state in which the program is entered.  That numbers can be typed, which a proof of
/// the program assumes, too, is not among it (docs/soundness-proofs.md, "Contracts in place of texts").
std::vector<smt::TermId> demandsOfCall(smt::TermStore &store, ContractTerms &terms, const Contract &contract,
                                       const SymbolicState &entered, const Dialect &dialect);

/// Refers to both.
CallContracts callContracts(SymbolicInterpretation &interpretation, const ProofSubject &subject);

/// The program, or one that it comes to, calls a program of the files whose contract promises something.
bool callsPromising(const ProofSubject &subject);

} // namespace feedhold::prove
