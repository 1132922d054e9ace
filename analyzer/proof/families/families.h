// The families of obligations: each one a function of the explored program.
#pragma once

#include "proof/context/proof_context.h"

namespace feedhold::prove {

// ---- questions about paths, which settle() answers ----
/// Of each place where a run may stop by itself: that none stops there.
Questions stopQuestions(const ExploredProgram &program);
/// Alarms in the text that no path comes to.
Questions unmetAlarms(const ExploredProgram &program);
/// What runs that follow the program exactly can break: calls, what the contract promises for the return, limits.
Questions promiseQuestions(const ExploredProgram &program);
Questions callQuestions(const ExploredProgram &program);
Questions ensureQuestions(const ExploredProgram &program);
Questions assignQuestions(const ExploredProgram &program);
Questions alarmQuestions(const ExploredProgram &program);
Questions limitQuestions(const ExploredProgram &program);

// ---- obligations that are settled in ways of their own ----
void settleLoops(const ProofContext &context, SettledRows &into);
/// Of the loop at this head alone.
Obligation loopRow(const ProofContext &context, Place head);
std::optional<Obligation> programEndRow(const ProofContext &context);
void settleEnd(const ProofContext &context, SettledRows &into);
/// What is claimed of all calls is not so of one that goes on for ever.
void requireEnds(const ProofContext &context, Obligation &obligation);
void settleSpace(const ProofContext &context, SettledRows &into);
/// Every call that the contract does not allow raises an alarm before an axis moves.
std::optional<Obligation> guardedRow(const ProofContext &context);

/// Marks the proofs that hold in exact arithmetic only.
void markRounding(const ProofContext &context, std::vector<Obligation> &rows);

} // namespace feedhold::prove
