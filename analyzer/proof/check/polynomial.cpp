#include "proof/check/polynomial.h"

#include "proof/smt/steps.h"

#include <algorithm>

namespace feedhold::check {

Polynomial constant(const Number &value) { return value.isZero() ? Polynomial() : Polynomial{{Monomial(), value}}; }

Polynomial variable(std::uint32_t index) { return {{Monomial{index}, Number(1)}}; }

void addTo(Polynomial &sum, const Polynomial &other, const Number &factor) {
  if (factor.isZero())
    return;
  smt::spend(10 * other.size());
  for (const auto &[monomial, coefficient] : other) {
    auto [place, isNew] = sum.try_emplace(monomial);
    place->second += coefficient * factor;
    if (place->second.isZero())
      sum.erase(place);
  }
}

Monomial multiply(const Monomial &left, const Monomial &right) {
  Monomial product(left.size() + right.size());
  std::merge(left.begin(), left.end(), right.begin(), right.end(), product.begin());
  return product;
}

Polynomial multiply(const Polynomial &left, const Polynomial &right) {
  smt::spend(15 * left.size() * right.size());
  Polynomial product;
  for (const auto &[leftMonomial, leftCoefficient] : left) {
    for (const auto &[rightMonomial, rightCoefficient] : right) {
      auto [place, isNew] = product.try_emplace(multiply(leftMonomial, rightMonomial));
      place->second += leftCoefficient * rightCoefficient;
      if (place->second.isZero())
        product.erase(place);
    }
  }
  return product;
}

Polynomial scaled(const Polynomial &polynomial, const Number &factor) {
  Polynomial result;
  addTo(result, polynomial, factor);
  return result;
}

Number constantOf(const Polynomial &polynomial) {
  auto found = polynomial.find(Monomial());
  return found == polynomial.end() ? Number() : found->second;
}

bool isConstant(const Polynomial &polynomial) {
  return polynomial.empty() || (polynomial.size() == 1 && polynomial.begin()->first.empty());
}

std::size_t degree(const Polynomial &polynomial) {
  std::size_t highest = 0;
  for (const auto &[monomial, coefficient] : polynomial)
    highest = std::max(highest, monomial.size());
  return highest;
}

} // namespace feedhold::check
