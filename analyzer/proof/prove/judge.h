// The judge: every run that the proofs of a program have made is held against every verdict on it.  A run that does
// what a verdict denies shows a bug in Feedhold: the verdict is withdrawn, and the bug is reported with its program
// and call.
#pragma once

#include "proof/context/proof_context.h"
#include "proof/prove/prove.h"

#include <vector>

namespace feedhold::prove {

/// Claims that hold in exact numbers, and that a run of the machine breaks because it rounds: these are refuted.
void refuteByRounding(const ProofContext &context, const std::vector<Denial> &denials, std::vector<Obligation> &rows);

/// `denials`: of claims that may be among the rows.  Each run is looked at by the predicate that would have made it the
/// witness of a refutation, and counts where it ends so in exact numbers, too.
std::vector<Contradiction> judge(const ProofContext &context, const std::vector<Denial> &denials,
                                 std::vector<Obligation> &rows);

/// Open claims that the run breaks.
void refute(const ProofContext &context, const std::vector<Denial> &denials, const WitnessSearch::Sample &run,
            std::vector<Obligation> &rows);

/// As judge(), for one more run.
std::vector<Contradiction> judgeRun(const ProofContext &context, const std::vector<Denial> &denials,
                                    const WitnessSearch::Sample &run, std::vector<Obligation> &rows);

} // namespace feedhold::prove
