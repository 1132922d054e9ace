// The families of obligations: each a function of the explored program.
#pragma once

#include "proof/context/proof_context.h"

namespace feedhold::prove {

// ---- questions about paths, which settle() answers ----
/// For each place where a run may stop with an alarm: no run stops there.
Questions stopQuestions(const ExploredProgram &program);
/// Alarms in the text that no path reaches.
Questions unmetAlarms(const ExploredProgram &program);
/// Claims that an exact run can refute: calls, promises for the return, limits.
Questions promiseQuestions(const ExploredProgram &program);
Questions callQuestions(const ExploredProgram &program);
Questions ensureQuestions(const ExploredProgram &program);
Questions assignQuestions(const ExploredProgram &program);
Questions alarmQuestions(const ExploredProgram &program);
Questions limitQuestions(const ExploredProgram &program);

// ---- obligations with a procedure of their own ----
void settleLoops(const ProofContext &context, SettledRows &into);
/// Of the loop at this head alone.
Obligation loopRow(const ProofContext &context, Place head);
std::optional<Obligation> programEndRow(const ProofContext &context);
void settleEnd(const ProofContext &context, SettledRows &into);
/// A claim about all calls needs that each of them ends.
void requireEnds(const ProofContext &context, Obligation &obligation);
void settleSpace(const ProofContext &context, SettledRows &into);
/// Every call that the contract does not allow raises an alarm before an axis moves.
std::optional<Obligation> guardedRow(const ProofContext &context);

/// Marks the proofs that hold in exact arithmetic only.
void markRounding(const ProofContext &context, std::vector<Obligation> &rows);

} // namespace feedhold::prove
