// The judge: every run that the proofs of a program have made is held against every verdict on it.  A run that does
// what a verdict denies shows a defect of Feedhold: the verdict is withdrawn, and the defect is told with its program
// and call.
#pragma once

#include "proof/prove/prove.h"
#include "proof/prove/witness.h"

#include <vector>

namespace feedhold::prove {

/// What the run does that the claim denies, in shop words; absent: the run does not speak of it.
std::optional<std::string> denial(const Obligation &row, const Contract *contract, const RunResult &run);

/// `witnesses`: has made the runs, and tells whether they end so in exact numbers, too.
std::vector<Contradiction> judge(const WitnessSearch &witnesses, const Contract *contract,
                                 std::vector<Obligation> &rows);

} // namespace feedhold::prove
