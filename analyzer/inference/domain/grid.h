// Grid: numbers at equal steps, such as the whole numbers or 0.25 + 0.5 n.
#pragma once

#include "base/support/rational.h"

#include <optional>

namespace feedhold {

/// Any real number, or offset + step * n for whole n; with step 0 one number alone.  Kept canonical:
/// 0 <= offset < step where there is a step.  What does not fit 64-bit fractions becomes any number.
/// (Granger, "Static analysis of arithmetical congruences", 1989, with rational steps.)
class Grid {
public:
  constexpr Grid() = default;
  static constexpr Grid any() { return {}; }
  static constexpr Grid constant(const Rational &value) { return Grid(value, Rational()); }
  /// The sign of the step does not matter.
  static Grid of(const Rational &step, const Rational &offset);
  static constexpr Grid integers() { return Grid(Rational(), Rational(1)); }

  constexpr bool isAny() const { return isAny_; }
  constexpr bool isConstant() const { return !isAny_ && step_.isZero(); }
  /// Every member is a whole number.
  constexpr bool isWhole() const { return !isAny_ && step_.isInteger() && offset_.isInteger(); }
  /// Meaningless for any().
  constexpr const Rational &step() const { return step_; }
  constexpr const Rational &offset() const { return offset_; }
  bool contains(const Rational &value) const { return isAny_ || differByMultiple(value, offset_, step_); }
  /// The exact value of the double is no member; false where that cannot be told.
  bool excludes(double value) const;
  /// A member is within the tolerance.
  bool contains(double value, double tolerance) const;

  /// The nearest members on each side; absent for any(), where there is none, and where it does not fit.
  std::optional<Rational> atOrAbove(const Rational &bound) const;
  std::optional<Rational> atOrBelow(const Rational &bound) const;

  friend bool operator==(const Grid &, const Grid &) = default;

private:
  constexpr Grid(const Rational &offset, const Rational &step) : offset_(offset), step_(step), isAny_(false) {}

  Rational offset_;
  Rational step_;
  bool isAny_ = true;
};

bool leq(const Grid &left, const Grid &right);
Grid join(const Grid &left, const Grid &right);
/// Absent when no number is in both; `left` where the common step does not fit.
std::optional<Grid> meet(const Grid &left, const Grid &right);
/// A number becomes a grid, a grid that must be finer the whole numbers or any number: chains end.
Grid widen(const Grid &old, const Grid &next);

Grid add(const Grid &left, const Grid &right);
Grid subtract(const Grid &left, const Grid &right);
Grid multiply(const Grid &left, const Grid &right);
Grid negate(const Grid &value);
/// any() for a divisor of 0.
Grid divideBy(const Grid &value, const Rational &divisor);
/// Of left - right * n for every whole n: what a remainder can be.
Grid remainder(const Grid &left, const Grid &right);

} // namespace feedhold
