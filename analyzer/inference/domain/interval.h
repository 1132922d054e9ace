// Interval: the numbers between two bounds, with bounds that hold for exact and for computed results alike.
#pragma once

#include "base/support/decimal.h"
#include "base/support/rational.h"

#include <limits>
#include <optional>
#include <span>

namespace feedhold {

/// Closed, never empty, bounds never NaN; an infinite bound means none on that side.  Every operation gives an
/// interval that contains, for all members, the exact real result and that result rounded to the nearest double;
/// where doubles compute exactly, the bounds are exact (1 + 1 is [2, 2]).
struct Interval {
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();

  static constexpr Interval all() { return {}; }
  static constexpr Interval constant(double value) { return {value + 0.0, value + 0.0}; }
  /// A point where the double nearest to the value is the value; otherwise its neighbours.
  static Interval of(const Decimal &value);
  static Interval of(const Rational &value);
  static constexpr Interval atLeast(double bound) { return {bound, std::numeric_limits<double>::infinity()}; }
  static constexpr Interval atMost(double bound) { return {-std::numeric_limits<double>::infinity(), bound}; }

  constexpr bool isConstant() const { return lo == hi; }
  constexpr bool contains(double value) const { return lo <= value && value <= hi; }
  constexpr bool contains(const Interval &other) const { return lo <= other.lo && other.hi <= hi; }
  constexpr bool isFinite() const {
    return lo > -std::numeric_limits<double>::infinity() && hi < std::numeric_limits<double>::infinity();
  }
  /// hi - lo, rounded up.
  double width() const;
  /// The largest magnitude of a member.
  constexpr double largest() const { return -lo > hi ? -lo : hi; }

  friend constexpr bool operator==(const Interval &, const Interval &) = default;
};

constexpr bool leq(const Interval &left, const Interval &right) { return right.contains(left); }
Interval join(const Interval &left, const Interval &right);
std::optional<Interval> meet(const Interval &left, const Interval &right);
/// A bound that grew goes to the next threshold (sorted, ascending), or to infinity behind the last.
Interval widen(const Interval &old, const Interval &next, std::span<const double> thresholds);
/// Takes the bounds of `next` where `old` has none.
Interval narrow(const Interval &old, const Interval &next);

Interval add(const Interval &left, const Interval &right);
Interval subtract(const Interval &left, const Interval &right);
Interval multiply(const Interval &left, const Interval &right);
/// All quotients by divisors other than 0; absent when 0 is the only divisor.
std::optional<Interval> divide(const Interval &left, const Interval &right);
/// left - right * fix(left / right), with the sign of left; absent when 0 is the only divisor.
std::optional<Interval> remainderTruncated(const Interval &left, const Interval &right);
Interval negate(const Interval &value);
Interval absolute(const Interval &value);

/// Towards zero, away from zero, down, up, to the nearest (halves away from zero).
Interval fix(const Interval &value);
Interval fup(const Interval &value);
Interval floor(const Interval &value);
Interval ceil(const Interval &value);
Interval roundHalfAwayFromZero(const Interval &value);

/// Functions of the part of the argument where they are defined; absent when there is none.  The bounds allow for
/// the error of libm: four units in the last place and 1e-15.  Angles are in degrees, exact at multiples of 90.
std::optional<Interval> sqrt(const Interval &value);
Interval sin(const Interval &angle);
Interval cos(const Interval &angle);
/// Everything where the angle may be an odd multiple of 90.
Interval tan(const Interval &angle);
std::optional<Interval> asin(const Interval &sine);
std::optional<Interval> acos(const Interval &cosine);
Interval atanDegrees(const Interval &tangent);
/// In (-180, 180].
Interval atan2Degrees(const Interval &y, const Interval &x);
std::optional<Interval> ln(const Interval &value);
Interval exp(const Interval &value);
/// A negative base has a power only for a whole exponent, and 0 only for one that is not negative.
std::optional<Interval> pow(const Interval &base, const Interval &exponent);

} // namespace feedhold
