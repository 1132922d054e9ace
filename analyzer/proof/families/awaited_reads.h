// @EVENTUALLY: the reads of inputs for which a program waits, and what the contract says of them.
//
// What is assumed: where one place of the text reads the input without end, values that the clause awaits come again
// and again.  So no run ends in nothing but iterations which pass the place once and go on only with another value.
#pragma once

#include "proof/context/proof_context.h"

namespace feedhold::prove {

/// Those that an iteration of the loop makes at a place to which it comes at most once, and where the text reads the
/// input once.
std::vector<AwaitedRead> awaitedReads(const ProofContext &context, const LoopInstance &loop);

/// The program reads an input that comes in the end: a run that repeats itself while the input stays as it is breaks
/// the assumption, and refutes nothing.
bool readsAwaited(const ProofContext &context);

} // namespace feedhold::prove
