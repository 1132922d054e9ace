// Purify: each quotient and function becomes a variable, with facts that are true of it wherever it is defined.
#pragma once

#include "proof/smt/term.h"

#include <optional>
#include <span>
#include <vector>

namespace feedhold::smt {

struct Definition {
  TermId variable;
  TermId application; ///< a Divide or Apply, whose arguments are purified
};

struct Purified {
  std::vector<TermId> formulas; ///< without Divide and Apply
  /// Facts about the new variables.  Each says nothing outside of the domain of its function: a quotient by 0 or the
  /// root of a negative number may be any number, so that no such term can prove anything.
  std::vector<TermId> facts;
  std::vector<Definition> definitions; ///< in the order in which they depend on one another
};

/// Together: the facts hold wherever all of the formulas do.  Apart: the facts always hold; formulas may be numbers,
/// too.
enum class Hold : std::uint8_t { Together, Apart };

/// Every assignment to the variables that satisfies the formulas can be extended to the new variables such that the
/// purified formulas and the facts hold.
Purified purify(TermStore &store, std::span<const TermId> formulas, Hold holds);

/// Weaker formulas about the numbers that there would be if nothing were rounded (deviations.h), not purified: where
/// those cannot hold together, neither can the given ones.  Absent: nothing is rounded.
std::optional<std::vector<TermId>> withoutRounding(TermStore &store, std::span<const TermId> formulas);

} // namespace feedhold::smt
