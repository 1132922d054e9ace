// Formulas that share no variable cannot contradict one another.
#pragma once

#include "proof/smt/term.h"

#include <span>
#include <vector>

namespace feedhold::prove {

/// The formulas in groups that share no variable, the smallest first.  They contradict one another exactly if those of
/// one group do.
std::vector<std::vector<smt::TermId>> independentParts(const smt::TermStore &store,
                                                       std::span<const smt::TermId> formulas);

} // namespace feedhold::prove
