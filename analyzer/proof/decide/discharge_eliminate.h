// Unknowns that an equality defines, put in where they are used: fewer unknowns, and integers come to light.
#pragma once

#include "proof/smt/model.h"
#include "proof/smt/term.h"

#include <vector>

namespace feedhold::prove {

struct Eliminated {
  std::vector<smt::TermId> formulas;
  std::vector<std::pair<smt::TermId, smt::TermId>> definitions; ///< variable, value; each over those that come later

  bool defines(smt::TermId variable) const;
};

/// Satisfiable exactly where the formulas are.
Eliminated eliminate(smt::TermStore &store, std::vector<smt::TermId> formulas);
/// Adds the eliminated variables.
void complete(const smt::TermStore &store, const Eliminated &eliminated, smt::Model &model);

} // namespace feedhold::prove
