// Signs of what a program computes from its arguments once and for all, `#21/FUP[#21/#22]`: known, they spare each
// claim about movements to find them again.
#pragma once

#include "proof/context/proof_start.h"

namespace feedhold::prove {

/// Facts that hold for all inputs that the contract allows, and only for those.
std::vector<smt::TermId> signsOfInputs(ProofStart &start, const Exploration &found);

} // namespace feedhold::prove
