// Whether a loop of an exploration ends: by a proof, or refuted by inputs with which it never ends.
#pragma once

#include "proof/context/proof_context.h"

namespace feedhold::prove {

/// Found out once: kept in the context.
const Termination &endOf(const ProofContext &context, const LoopInstance &loop);

} // namespace feedhold::prove
