// Slopes: vectors whose direction is the same for all arguments.  Their lengths have no squares of arguments, and a
// distance from their lines is linear in the coordinates.
#pragma once

#include "proof/smt/term.h"

#include <optional>

namespace feedhold::geometry {

/// A vector (x, y) as a multiple of two whole numbers without a common divisor; `times` may be below 0.
struct Slope {
  smt::Number first;
  smt::Number second;
  smt::TermId times;
};

/// Told by the form of the terms.  Absent for (0, 0), and where the direction depends on an argument.
std::optional<Slope> slopeOf(smt::TermStore &store, smt::TermId x, smt::TermId y);

/// Of the two whole numbers of a slope.
smt::TermId lengthOf(smt::TermStore &store, const Slope &slope);

/// Of any vector.
smt::TermId lengthOf(smt::TermStore &store, smt::TermId x, smt::TermId y);

} // namespace feedhold::geometry
