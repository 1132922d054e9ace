// What sums of squares and roots say of single numbers, as linear facts: a search would have to guess the products that
// show them.
//
// Lemmas, true of all real numbers:
//   f x^2 + (other squares) <= c, with f > 0 and c <= f r^2, r >= 0, gives |x| <= r;
//   f x^2 + (other squares) <= g y^2, with f >= g > 0 and y >= 0, gives |x| <= y;
//   low^2 <= c <= high^2, with low, high >= 0, gives low <= sqrt(c) <= high.
#pragma once

#include "proof/smt/term.h"

#include <span>
#include <vector>

namespace feedhold::smt {

/// Of the comparisons in the formulas.  Each fact has its comparison as a condition, and is true of all numbers.
std::vector<TermId> squareFacts(TermStore &store, std::span<const TermId> formulas);

struct RootBounds {
  Number low, high;
};
/// Of a number that is not negative.
RootBounds rootBounds(const Number &value);

} // namespace feedhold::smt
