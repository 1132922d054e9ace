// Polynomial: exact, sparse, over variables by number.
#pragma once

#include "proof/smt/number.h"

#include <cstdint>
#include <map>
#include <vector>

namespace feedhold::check {

using smt::Number;

/// Variables in ascending order, each as often as its power; empty for 1.
using Monomial = std::vector<std::uint32_t>;
/// No coefficient is 0, so that equal polynomials are equal maps.
using Polynomial = std::map<Monomial, Number>;

Polynomial constant(const Number &value);
Polynomial variable(std::uint32_t index);
void addTo(Polynomial &sum, const Polynomial &other, const Number &factor = Number(1));
Polynomial multiply(const Polynomial &left, const Polynomial &right);
Polynomial scaled(const Polynomial &polynomial, const Number &factor);
Monomial multiply(const Monomial &left, const Monomial &right);
/// The coefficient of 1.
Number constantOf(const Polynomial &polynomial);
bool isConstant(const Polynomial &polynomial);
std::size_t degree(const Polynomial &polynomial);

} // namespace feedhold::check
