// Unit resolution: alternatives that the other formulas rule out are dropped, before anything splits on them.
#pragma once

#include "proof/smt/bounds.h"

namespace feedhold::smt {

/// Formulas that hold together wherever the given ones do, and nowhere else: without alternatives that a formula or
/// the bounds of the numbers contradict, and without those of which one holds for certain.  Bools without quotients
/// and functions.
std::vector<TermId> resolveUnits(TermStore &store, std::vector<TermId> formulas);

} // namespace feedhold::smt
