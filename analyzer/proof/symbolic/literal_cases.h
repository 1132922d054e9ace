// Numbers that are one literal or another, as conditions decide: `X50` is 50 or 0.05 by a setting of the machine, in
// inch or in millimetres.  What is computed of such numbers is computed in each case, and stays a choice among
// literals: polynomials over choices would be left to the solver.
#pragma once

#include "proof/smt/term.h"

#include <array>
#include <optional>

namespace feedhold::prove {

/// Two numbers where the condition holds, and where it does not.
struct LiteralCases {
  smt::TermId condition;
  std::array<smt::TermId, 2> ifSo, ifNot;
};

/// By one of the conditions.  Absent: not both are choices among few literals, or both are literals.
std::optional<LiteralCases> literalCases(smt::TermStore &store, smt::TermId first, smt::TermId second);

} // namespace feedhold::prove
