// AbstractNumber: what is known of a number: its bounds, its grid, and its few possible values.
#pragma once

#include "base/support/decimal.h"
#include "base/support/truth.h"
#include "inference/domain/finite_set.h"
#include "inference/domain/grid.h"
#include "inference/domain/interval.h"

#include <cstdint>
#include <optional>
#include <span>

namespace feedhold {

/// A program may be read with exact real numbers or with doubles, and how a control computes is not published.  Both
/// readings are kept: the interval holds the values of both.  Exact: grid and set do so too.  Rounded: the readings
/// may differ (as they do from 0.1 on); then the grid speaks of the real value alone, and the set of the computed one.
enum class Exactness : std::uint8_t { Exact, Rounded };

/// Never empty; the parts are reduced against each other.  No heap.
class AbstractNumber {
public:
  /// Any number.
  constexpr AbstractNumber() = default;
  static constexpr AbstractNumber any() { return {}; }
  static AbstractNumber constant(const Decimal &value);
  static AbstractNumber constant(double value);
  static AbstractNumber inInterval(const Interval &interval);
  /// The whole numbers of an interval that has one.
  static AbstractNumber integersIn(const Interval &interval);
  /// Absent when nothing satisfies all three.
  static std::optional<AbstractNumber> of(const Interval &interval, const Grid &grid, const FiniteSet &set,
                                          Exactness exactness);

  constexpr const Interval &interval() const { return interval_; }
  constexpr const Grid &grid() const { return grid_; }
  constexpr const FiniteSet &set() const { return set_; }
  constexpr bool isExact() const { return exactness_ == Exactness::Exact; }
  /// Only the interval says anything.
  constexpr bool isInterval() const { return grid_.isAny() && set_.isMany(); }
  /// One computed value alone (and one real value, near it or equal).
  constexpr bool isConstant() const { return set_.isConstant(); }
  /// The computed value of a constant.
  std::optional<double> constantValue() const;
  /// Whole in both readings.
  constexpr bool isWhole() const { return isExact() && grid_.isWhole(); }
  /// May be a computed value.
  bool contains(double value) const;
  /// May be a real value.
  bool containsExactly(const Rational &value) const;

  friend bool operator==(const AbstractNumber &, const AbstractNumber &) = default;

private:
  friend struct NumberParts;

  Interval interval_;
  Grid grid_;
  FiniteSet set_;
  Exactness exactness_ = Exactness::Exact;
};

bool leq(const AbstractNumber &left, const AbstractNumber &right);
AbstractNumber join(const AbstractNumber &left, const AbstractNumber &right);
/// Also what follows from left EQ right.
std::optional<AbstractNumber> meet(const AbstractNumber &left, const AbstractNumber &right);
/// Thresholds ascend.
AbstractNumber widen(const AbstractNumber &old, const AbstractNumber &next, std::span<const double> thresholds);
/// `next` is not above `old`.
AbstractNumber narrow(const AbstractNumber &old, const AbstractNumber &next);

/// What is left of a number that is compared with a bound; absent when nothing is.
std::optional<AbstractNumber> meetAtMost(const AbstractNumber &value, double bound);
std::optional<AbstractNumber> meetAtLeast(const AbstractNumber &value, double bound);
std::optional<AbstractNumber> meetLess(const AbstractNumber &value, double bound);
std::optional<AbstractNumber> meetGreater(const AbstractNumber &value, double bound);
/// Takes out one value, as far as the parts can say so.
std::optional<AbstractNumber> remove(const AbstractNumber &value, double taken);

/// Of both readings.
Truth isEqual(const AbstractNumber &left, const AbstractNumber &right);
Truth isLess(const AbstractNumber &left, const AbstractNumber &right);
Truth isAtMost(const AbstractNumber &left, const AbstractNumber &right);

AbstractNumber add(const AbstractNumber &left, const AbstractNumber &right);
AbstractNumber subtract(const AbstractNumber &left, const AbstractNumber &right);
AbstractNumber multiply(const AbstractNumber &left, const AbstractNumber &right);
/// By the divisors other than 0; absent when there is none.
std::optional<AbstractNumber> divide(const AbstractNumber &left, const AbstractNumber &right);
/// left - right * fix(left / right), for divisors other than 0.
std::optional<AbstractNumber> remainderTruncated(const AbstractNumber &left, const AbstractNumber &right);
AbstractNumber negate(const AbstractNumber &value);
AbstractNumber absolute(const AbstractNumber &value);

/// To whole numbers: towards zero, away from zero, to the nearest (halves away from zero), down, up.
AbstractNumber fix(const AbstractNumber &value);
AbstractNumber fup(const AbstractNumber &value);
AbstractNumber round(const AbstractNumber &value);
AbstractNumber floorOf(const AbstractNumber &value);
AbstractNumber ceilOf(const AbstractNumber &value);

/// Of the part of the argument where the function is defined; absent when there is none.  Angles in degrees.
std::optional<AbstractNumber> sqrt(const AbstractNumber &value);
AbstractNumber sin(const AbstractNumber &angle);
AbstractNumber cos(const AbstractNumber &angle);
AbstractNumber tan(const AbstractNumber &angle);
std::optional<AbstractNumber> asin(const AbstractNumber &sine);
std::optional<AbstractNumber> acos(const AbstractNumber &cosine);
AbstractNumber atanDegrees(const AbstractNumber &tangent);
AbstractNumber atan2Degrees(const AbstractNumber &y, const AbstractNumber &x);
std::optional<AbstractNumber> ln(const AbstractNumber &value);
AbstractNumber exp(const AbstractNumber &value);
std::optional<AbstractNumber> pow(const AbstractNumber &base, const AbstractNumber &exponent);

} // namespace feedhold
