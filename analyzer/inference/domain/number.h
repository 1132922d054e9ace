// AbstractNumber: what is known of a number: its bounds, its grid, and its few possible values.
#pragma once

#include "base/support/decimal.h"
#include "base/support/truth.h"
#include "inference/domain/number_parts.h"

#include <memory>
#include <optional>
#include <span>

namespace feedhold {

/// Never empty; the parts are reduced against each other.  They never change, and all copies share them: a state holds
/// some two hundred numbers, and from one block to the next nearly all of them stay what they are.
class AbstractNumber {
public:
  /// Any number.
  AbstractNumber() = default;
  static AbstractNumber any() { return {}; }
  static AbstractNumber constant(const Decimal &value);
  static AbstractNumber constant(double value);
  static AbstractNumber inInterval(const Interval &interval);
  /// The whole numbers of an interval that has one.
  static AbstractNumber integersIn(const Interval &interval);
  /// Absent when nothing satisfies all three.
  static std::optional<AbstractNumber> of(const Interval &interval, const Grid &grid, const FiniteSet &set,
                                          Exactness exactness);

  const NumberParts &parts() const { return parts_ ? *parts_ : kAnyParts; }
  const Interval &interval() const { return parts().interval; }
  const Grid &grid() const { return parts().grid; }
  const FiniteSet &set() const { return parts().set; }
  bool isExact() const { return parts().exactness == Exactness::Exact; }
  /// Only the interval says anything.
  bool isInterval() const { return grid().isAny() && set().isMany(); }
  /// One computed value alone (and one real value, near it or equal).
  bool isConstant() const { return set().isConstant(); }
  /// The computed value of a constant.
  std::optional<double> constantValue() const;
  /// Whole in both arithmetics.
  bool isWhole() const { return isExact() && grid().isWhole(); }
  /// May be a computed value.
  bool contains(double value) const;
  /// May be a real value.
  bool containsExactly(const Rational &value) const;

  /// Copies of one number.  No: they may be equal all the same.
  bool isCopyOf(const AbstractNumber &other) const { return parts_ == other.parts_; }
  /// Of copies the same; for tables.
  std::size_t hash() const { return std::hash<const NumberParts *>{}(parts_.get()); }
  friend bool operator==(const AbstractNumber &left, const AbstractNumber &right) {
    return left.isCopyOf(right) || left.parts() == right.parts();
  }

private:
  friend struct NumberParts;
  static constexpr NumberParts kAnyParts{};

  std::shared_ptr<const NumberParts> parts_; // null: any number
};

/// Of what is computed from two numbers.
inline Exactness both(const AbstractNumber &left, const AbstractNumber &right) {
  return left.isExact() && right.isExact() ? Exactness::Exact : Exactness::Rounded;
}

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

/// Of both arithmetics.
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
