// The stage `verdicts`: what `feedhold prove` says of each obligation, a row each.
#pragma once

#include "findings/session/proofs.h"

namespace feedhold::golden {

/// `line 4: proved: this loop ends`, with the reason of what is unknown and the witness of what is refuted.
std::string verdictsOf(const ProofsResult &result);

} // namespace feedhold::golden
