// Intervals: lattice operations, arithmetic and rounding to whole numbers.
#include "inference/domain/interval.h"

#include "inference/domain/rounding.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace feedhold {

namespace {

using rounding::Bounds;
using rounding::kInfinity;

Interval hullOf(const std::array<Bounds, 4> &corners) {
  Interval hull{corners[0].down, corners[0].up};
  for (const Bounds &corner : corners) {
    hull.lo = std::min(hull.lo, corner.down);
    hull.hi = std::max(hull.hi, corner.up);
  }
  return {hull.lo + 0.0, hull.hi + 0.0};
}

Interval aroundValue(double value) { return {rounding::below(value), rounding::above(value)}; }

/// Quotients by a divisor that does not change its sign, though 0 may be one of its bounds.
Interval divideBySigned(const Interval &left, const Interval &right) {
  // A divisor that comes near 0 makes every quotient of its sign possible: the bound at 0 goes to infinity.
  if (right.lo == 0 || right.hi == 0) {
    const double far = right.lo == 0 ? right.hi : right.lo;
    const Interval near{rounding::divide(left.lo, far).down, rounding::divide(left.hi, far).up};
    const Interval turned{rounding::divide(left.hi, far).down, rounding::divide(left.lo, far).up};
    Interval result = far > 0 ? near : turned;
    const bool canBeNegative = far > 0 ? left.lo < 0 : left.hi > 0;
    const bool canBePositive = far > 0 ? left.hi > 0 : left.lo < 0;
    if (canBeNegative)
      result.lo = -kInfinity;
    if (canBePositive)
      result.hi = kInfinity;
    return {result.lo + 0.0, result.hi + 0.0};
  }
  return hullOf({rounding::divide(left.lo, right.lo), rounding::divide(left.lo, right.hi),
                 rounding::divide(left.hi, right.lo), rounding::divide(left.hi, right.hi)});
}

/// The remainder by divisors of magnitude `divisor` alone, where all quotients have the same whole part.
std::optional<Interval> remainderInOneBand(const Interval &left, double divisor) {
  if (!left.isFinite() || (left.lo < 0 && left.hi > 0))
    return std::nullopt;
  const double first = std::fmod(left.lo, divisor);
  const double last = std::fmod(left.hi, divisor);
  // fmod is exact; within one band the remainder grows with the dividend, and the band is narrower than the divisor.
  if (first > last || rounding::add(left.hi, -left.lo).up >= divisor)
    return std::nullopt;
  return Interval{first + 0.0, last + 0.0};
}

} // namespace

Interval Interval::of(const Rational &value) {
  const double rounded = value.toDouble();
  return Rational::fromDouble(rounded) == value ? constant(rounded) : aroundValue(rounded);
}

Interval Interval::of(const Decimal &value) {
  const double rounded = value.toDouble();
  const auto exact = Rational::fromDecimal(value);
  return exact && Rational::fromDouble(rounded) == exact ? constant(rounded) : aroundValue(rounded);
}

double Interval::width() const { return rounding::add(hi, -lo).up; }

Interval join(const Interval &left, const Interval &right) {
  return {std::min(left.lo, right.lo), std::max(left.hi, right.hi)};
}

std::optional<Interval> meet(const Interval &left, const Interval &right) {
  const Interval both{std::max(left.lo, right.lo), std::min(left.hi, right.hi)};
  if (both.lo > both.hi)
    return std::nullopt;
  return both;
}

Interval widen(const Interval &old, const Interval &next, std::span<const double> thresholds) {
  Interval result = old;
  if (next.lo < old.lo) {
    const auto after = std::upper_bound(thresholds.begin(), thresholds.end(), next.lo);
    result.lo = after == thresholds.begin() ? -kInfinity : *(after - 1);
  }
  if (next.hi > old.hi) {
    const auto at = std::lower_bound(thresholds.begin(), thresholds.end(), next.hi);
    result.hi = at == thresholds.end() ? kInfinity : *at;
  }
  return result;
}

Interval narrow(const Interval &old, const Interval &next) {
  return {old.lo == -kInfinity ? next.lo : old.lo, old.hi == kInfinity ? next.hi : old.hi};
}

Interval add(const Interval &left, const Interval &right) {
  const Bounds low = rounding::add(left.lo, right.lo);
  const Bounds high = rounding::add(left.hi, right.hi);
  return {low.down + 0.0, high.up + 0.0};
}

Interval subtract(const Interval &left, const Interval &right) { return add(left, negate(right)); }

Interval multiply(const Interval &left, const Interval &right) {
  return hullOf({rounding::multiply(left.lo, right.lo), rounding::multiply(left.lo, right.hi),
                 rounding::multiply(left.hi, right.lo), rounding::multiply(left.hi, right.hi)});
}

std::optional<Interval> divide(const Interval &left, const Interval &right) {
  if (right.lo == 0 && right.hi == 0)
    return std::nullopt;
  if (right.lo >= 0 || right.hi <= 0)
    return divideBySigned(left, right);
  return join(divideBySigned(left, {right.lo, 0}), divideBySigned(left, {0, right.hi}));
}

std::optional<Interval> remainderTruncated(const Interval &left, const Interval &right) {
  if (right.lo == 0 && right.hi == 0)
    return std::nullopt;
  if (right.lo == right.hi) {
    if (const auto band = remainderInOneBand(left, std::abs(right.lo)))
      return band;
  }
  // Its magnitude is below that of the divisor and not above that of the dividend, and it has the dividend's sign.
  const double most = right.largest();
  const Interval result{left.lo < 0 ? std::max(left.lo, -most) : 0, left.hi > 0 ? std::min(left.hi, most) : 0};
  // A dividend that stays below every divisor is its own remainder.
  const Interval magnitude = absolute(right);
  return left.largest() < magnitude.lo ? left : result;
}

Interval negate(const Interval &value) { return {0 - value.hi, 0 - value.lo}; }

Interval absolute(const Interval &value) {
  if (value.lo >= 0)
    return value;
  if (value.hi <= 0)
    return negate(value);
  return {0, std::max(-value.lo, value.hi)};
}

Interval fix(const Interval &value) { return {std::trunc(value.lo) + 0.0, std::trunc(value.hi) + 0.0}; }

Interval fup(const Interval &value) {
  const auto away = [](double bound) { return bound < 0 ? std::floor(bound) : std::ceil(bound); };
  return {away(value.lo) + 0.0, away(value.hi) + 0.0};
}

Interval floor(const Interval &value) { return {std::floor(value.lo), std::floor(value.hi)}; }

Interval ceil(const Interval &value) { return {std::ceil(value.lo) + 0.0, std::ceil(value.hi) + 0.0}; }

Interval roundHalfAwayFromZero(const Interval &value) {
  return {std::round(value.lo) + 0.0, std::round(value.hi) + 0.0};
}

} // namespace feedhold
