// Numbers: arithmetic, rounding to whole numbers, and functions.
#include "inference/domain/number.h"

#include "inference/domain/rounding.h"

#include <cmath>

namespace feedhold {

namespace {

using rounding::Bounds;

/// Every pair of members has an exact result.
template <typename Operation> bool areExact(const FiniteSet &left, const FiniteSet &right, Operation &&bounds) {
  if (left.isMany() || right.isMany())
    return false;
  for (const double first : left.values()) {
    for (const double second : right.values()) {
      const Bounds result = bounds(first, second);
      if (result.down != result.up)
        return false;
    }
  }
  return true;
}

/// The result of an operation whose operands are exact, as long as doubles compute it without rounding.
template <typename Operation>
Exactness exactnessOfResult(const AbstractNumber &left, const AbstractNumber &right, const NumberParts &result,
                            Operation &&bounds) {
  if (both(left, right) == Exactness::Rounded || result.interval.isConstant())
    return both(left, right);
  const bool isExact = areExact(left.set(), right.set(), bounds) || fitsDoubles(result.grid, result.interval);
  return isExact ? Exactness::Exact : Exactness::Rounded;
}

FiniteSet nonZero(const FiniteSet &set) {
  return set.filter([](double value) { return value != 0; }).value_or(FiniteSet::many());
}

/// Of a function to whole numbers that grows with its argument.
template <typename Function>
AbstractNumber toWhole(const AbstractNumber &value, const Interval &interval, Function &&function) {
  // Two results that differ a little can come to lie on two whole numbers: only the interval holds both.
  if (!value.isExact())
    return AbstractNumber::integersIn(interval);
  const Grid grid = value.grid().isWhole() ? value.grid() : Grid::integers();
  return NumberParts{interval, grid, value.set().map(function), Exactness::Exact}.result();
}

std::optional<AbstractNumber> inIntervalIfAny(const std::optional<Interval> &interval) {
  return interval ? std::optional(AbstractNumber::inInterval(*interval)) : std::nullopt;
}

} // namespace

AbstractNumber add(const AbstractNumber &left, const AbstractNumber &right) {
  NumberParts sum{add(left.interval(), right.interval()), add(left.grid(), right.grid()),
                  FiniteSet::combine(left.set(), right.set(), [](double a, double b) { return a + b; })};
  sum.exactness = exactnessOfResult(left, right, sum, rounding::add);
  return sum.result();
}

AbstractNumber subtract(const AbstractNumber &left, const AbstractNumber &right) { return add(left, negate(right)); }

AbstractNumber multiply(const AbstractNumber &left, const AbstractNumber &right) {
  NumberParts product{multiply(left.interval(), right.interval()), multiply(left.grid(), right.grid()),
                      FiniteSet::combine(left.set(), right.set(), [](double a, double b) { return a * b; })};
  product.exactness = exactnessOfResult(left, right, product, rounding::multiply);
  return product.result();
}

std::optional<AbstractNumber> divide(const AbstractNumber &left, const AbstractNumber &right) {
  const auto interval = divide(left.interval(), right.interval());
  if (!interval)
    return std::nullopt;
  const FiniteSet divisors = nonZero(right.set());
  NumberParts quotient{*interval,
                       right.grid().isConstant() ? divideBy(left.grid(), right.grid().offset()) : Grid::any(),
                       FiniteSet::combine(left.set(), divisors, [](double a, double b) { return a / b; })};
  const auto bounds = [](double a, double b) { return b == 0 ? Bounds{0, 0} : rounding::divide(a, b); };
  quotient.exactness = exactnessOfResult(left, right, quotient, bounds);
  return quotient.result();
}

std::optional<AbstractNumber> remainderTruncated(const AbstractNumber &left, const AbstractNumber &right) {
  const auto interval = remainderTruncated(left.interval(), right.interval());
  if (!interval)
    return std::nullopt;
  // fmod is exact (C17 F.10.7.1), so that the results differ no more than they did before.
  return NumberParts{
      *interval, remainder(left.grid(), right.grid()),
      FiniteSet::combine(left.set(), nonZero(right.set()), [](double a, double b) { return std::fmod(a, b); }),
      both(left, right)}
      .result();
}

AbstractNumber negate(const AbstractNumber &value) {
  return NumberParts{negate(value.interval()), negate(value.grid()), value.set().map([](double a) { return -a; }),
                     value.parts().exactness}
      .asGiven();
}

AbstractNumber absolute(const AbstractNumber &value) {
  if (value.interval().lo >= 0)
    return value;
  if (value.interval().hi <= 0)
    return negate(value);
  return NumberParts{absolute(value.interval()), join(value.grid(), negate(value.grid())),
                     value.set().map([](double a) { return std::abs(a); }), value.parts().exactness}
      .result();
}

AbstractNumber fix(const AbstractNumber &value) {
  return toWhole(value, fix(value.interval()), [](double a) { return std::trunc(a); });
}

AbstractNumber fup(const AbstractNumber &value) {
  return toWhole(value, fup(value.interval()), [](double a) { return a < 0 ? std::floor(a) : std::ceil(a); });
}

AbstractNumber round(const AbstractNumber &value) {
  return toWhole(value, roundHalfAwayFromZero(value.interval()), [](double a) { return std::round(a); });
}

AbstractNumber floorOf(const AbstractNumber &value) {
  return toWhole(value, floor(value.interval()), [](double a) { return std::floor(a); });
}

AbstractNumber ceilOf(const AbstractNumber &value) {
  return toWhole(value, ceil(value.interval()), [](double a) { return std::ceil(a); });
}

std::optional<AbstractNumber> sqrt(const AbstractNumber &value) {
  const auto interval = sqrt(value.interval());
  if (!interval)
    return std::nullopt;
  const FiniteSet radicands = value.set().filter([](double a) { return a >= 0; }).value_or(FiniteSet::many());
  const FiniteSet roots = radicands.map([](double a) { return std::sqrt(a); });
  const auto bounds = [](double a, double) { return rounding::squareRoot(a); };
  const bool isExact = value.isExact() && areExact(radicands, FiniteSet::constant(0), bounds);
  return NumberParts{*interval, Grid::any(), roots, isExact ? Exactness::Exact : Exactness::Rounded}.result();
}

// How a control or libm rounds these in the last place is not known: the interval alone holds the result.
AbstractNumber sin(const AbstractNumber &angle) { return AbstractNumber::inInterval(sin(angle.interval())); }

AbstractNumber cos(const AbstractNumber &angle) { return AbstractNumber::inInterval(cos(angle.interval())); }

AbstractNumber tan(const AbstractNumber &angle) { return AbstractNumber::inInterval(tan(angle.interval())); }

std::optional<AbstractNumber> asin(const AbstractNumber &sine) { return inIntervalIfAny(asin(sine.interval())); }

std::optional<AbstractNumber> acos(const AbstractNumber &cosine) { return inIntervalIfAny(acos(cosine.interval())); }

AbstractNumber atanDegrees(const AbstractNumber &tangent) {
  return AbstractNumber::inInterval(atanDegrees(tangent.interval()));
}

AbstractNumber atan2Degrees(const AbstractNumber &y, const AbstractNumber &x) {
  return AbstractNumber::inInterval(atan2Degrees(y.interval(), x.interval()));
}

std::optional<AbstractNumber> ln(const AbstractNumber &value) { return inIntervalIfAny(ln(value.interval())); }

AbstractNumber exp(const AbstractNumber &value) { return AbstractNumber::inInterval(exp(value.interval())); }

std::optional<AbstractNumber> pow(const AbstractNumber &base, const AbstractNumber &exponent) {
  return inIntervalIfAny(pow(base.interval(), exponent.interval()));
}

} // namespace feedhold
