#include "proof/smt/rounding_facts.h"

#include "proof/smt/deviations.h"

#include <cmath>

namespace feedhold::smt {
namespace {

Number powerOfTwo(int exponent) { return Number::fromDouble(std::ldexp(1.0, exponent)); }

/// Bounds with many digits make proofs long and say little more than the distance from the exact number does.
bool isPlain(double bound) { return std::isfinite(bound) && std::floor(bound * 1024) == bound * 1024; }

TermId within(TermStore &store, TermId value, TermId exact, TermId distance) {
  return store.logicalAnd(store.lessOrEqual(store.subtract(exact, distance), value),
                          store.lessOrEqual(value, store.add(exact, distance)));
}

/// |v - t| <= 2^-53 t where `sign` * t is not negative.
TermId relative(TermStore &store, TermId value, TermId exact, int sign) {
  return within(store, value, exact, store.scale(Number(sign) * powerOfTwo(-53), exact));
}

} // namespace

std::vector<TermId> nearestFacts(TermStore &store, const Bounds &bounds, TermId rounded, TermId exact) {
  const TermId zero = store.number(Number(0));
  const Interval range = bounds.of(exact);
  std::vector<TermId> facts;
  if (isPlain(range.lo))
    facts.push_back(store.lessOrEqual(store.number(Number::fromDouble(range.lo)), rounded));
  if (isPlain(range.hi))
    facts.push_back(store.lessOrEqual(rounded, store.number(Number::fromDouble(range.hi))));
  if (range.isFinite()) {
    facts.push_back(within(store, rounded, exact, store.number(Number::fromDouble(halfUnitOf(range)))));
  } else if (range.lo >= 0) {
    facts.push_back(relative(store, rounded, exact, 1));
  } else if (range.hi <= 0) {
    facts.push_back(relative(store, rounded, exact, -1));
  } else {
    const TermId isPositive = store.logicalAnd(store.lessOrEqual(zero, exact), relative(store, rounded, exact, 1));
    const TermId isNegative = store.logicalAnd(store.lessOrEqual(exact, zero), relative(store, rounded, exact, -1));
    facts.push_back(store.logicalOr(isPositive, isNegative));
  }
  return facts;
}

std::optional<TermId> differenceFact(TermStore &store, const Bounds &bounds, TermId rounded, TermId first,
                                     TermId second) {
  const Interval a = bounds.of(first), b = bounds.of(second);
  const bool mayBeNegative = a.lo < 0 || b.lo < 0;
  if ((mayBeNegative && !store.isNumber(first) && !store.isNumber(second)) || a.hi < b.lo / 2 || b.hi < a.lo / 2)
    return std::nullopt;
  if (!mayBeNegative && a.hi <= 2 * b.lo && b.hi <= 2 * a.lo)
    return store.equal(rounded, store.subtract(first, second));
  const TermId isNear = store.logicalAnd(store.lessOrEqual(first, store.scale(Number(2), second)),
                                         store.lessOrEqual(second, store.scale(Number(2), first)));
  return store.implies(isNear, store.equal(rounded, store.subtract(first, second)));
}

std::vector<TermId> rootFacts(TermStore &store, TermId root, TermId argument, TermId square, TermId base) {
  const TermId magnitude = store.absolute(base);
  if (argument == square)
    return {store.equal(root, magnitude)};
  return {store.implies(store.lessOrEqual(argument, square), store.lessOrEqual(root, magnitude)),
          store.implies(store.lessOrEqual(square, argument), store.lessOrEqual(magnitude, root))};
}

std::vector<TermId> nearFacts(TermStore &store, TermId value, TermId exact, TermId distance) {
  return {within(store, value, exact, distance)};
}

std::vector<TermId> orderFacts(TermStore &store, const Bounds &bounds, std::pair<TermId, TermId> first,
                               std::pair<TermId, TermId> second) {
  const TermId isInOrder = store.lessOrEqual(first.first, second.first);
  const TermId isReversed = store.lessOrEqual(second.first, first.first);
  const Interval apart = bounds.of(store.subtract(second.second, first.second));
  if (apart.lo >= 0)
    return {isInOrder};
  if (apart.hi <= 0)
    return {isReversed};
  return {store.implies(store.lessOrEqual(first.second, second.second), isInOrder),
          store.implies(store.lessOrEqual(second.second, first.second), isReversed)};
}

} // namespace feedhold::smt
