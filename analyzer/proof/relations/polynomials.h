// Polynomial equalities that hold at all of some points: guesses about the numbers that runs leave, by exact linear
// algebra over monomials (Sharma et al., "A data driven approach for algebraic loop invariants", 2013).
#pragma once

#include "proof/smt/number.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace feedhold::prove {

/// Variables by index, ascending, each as often as its power says; empty: 1.
using Monomial = std::vector<std::size_t>;
/// The sum of factor times monomial is 0.
using PolynomialEquality = std::vector<std::pair<smt::Number, Monomial>>;

/// Linear ones first, then those of a higher degree over the variables that these leave.  No equality of which there
/// are too few points to tell.
std::vector<PolynomialEquality> equalitiesAt(const std::vector<std::vector<smt::Number>> &points,
                                             std::size_t variables);

} // namespace feedhold::prove
