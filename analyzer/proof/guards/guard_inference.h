// Guard inference: conditions on the inputs under which an open or refuted claim is proved.
#pragma once

#include "proof/context/proof_context.h"

namespace feedhold::prove {

/// To the verdicts on claims that are not proved.  `open`: their questions, where they have any.
void addGuards(const ProofContext &context, const std::vector<Question> &open, std::vector<Obligation> &rows);

} // namespace feedhold::prove
