#include "proof/geometry/slope.h"

namespace feedhold::geometry {

using smt::LinearSum;
using smt::Number;
using smt::TermId;

namespace {

/// `sum` over `other`, where one is a multiple of the other by a number.
std::optional<Number> ratioOf(const LinearSum &sum, const LinearSum &other) {
  const auto leading = [](const LinearSum &of) { return of.terms.empty() ? of.constant : of.terms.front().second; };
  if (sum.terms.size() != other.terms.size() || leading(other).isZero())
    return std::nullopt;
  const Number ratio = leading(sum) / leading(other);
  if (sum.constant != ratio * other.constant)
    return std::nullopt;
  for (std::size_t i = 0; i < sum.terms.size(); ++i)
    if (sum.terms[i].first != other.terms[i].first || sum.terms[i].second != ratio * other.terms[i].second)
      return std::nullopt;
  return ratio;
}

} // namespace

std::optional<Slope> slopeOf(smt::TermStore &store, TermId x, TermId y) {
  const TermId zero = store.number(Number(0));
  if (x == zero)
    return y == zero ? std::nullopt : std::optional(Slope{0, 1, y});
  if (y == zero)
    return Slope{1, 0, x};
  const auto ratio = ratioOf(store.linear(y), store.linear(x));
  if (!ratio)
    return std::nullopt;
  const Number first = ratio->denominator();
  return Slope{first, ratio->numerator(), store.scale(Number(1) / first, x)};
}

TermId lengthOf(smt::TermStore &store, const Slope &slope) {
  return store.apply(smt::Function::Sqrt, store.number(slope.first * slope.first + slope.second * slope.second));
}

TermId lengthOf(smt::TermStore &store, TermId x, TermId y) {
  if (const auto slope = slopeOf(store, x, y))
    return store.multiply(store.absolute(slope->times), lengthOf(store, *slope));
  return store.apply(smt::Function::Sqrt, store.add(store.multiply(x, x), store.multiply(y, y)));
}

} // namespace feedhold::geometry
