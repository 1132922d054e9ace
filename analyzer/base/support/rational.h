// Rational: an exact fraction of two 64-bit integers.
#pragma once

#include "base/support/decimal.h"

#include <compare>
#include <cstdint>
#include <optional>
#include <string>

namespace feedhold {

/// numerator / denominator in lowest terms, denominator > 0.  What does not fit is absent, never rounded.
class Rational {
public:
  constexpr Rational() = default;
  constexpr explicit Rational(std::int64_t integer) : numerator_(integer) {}
  /// Absent when the denominator is 0 or the reduced fraction does not fit.
  static std::optional<Rational> make(std::int64_t numerator, std::int64_t denominator);
  static std::optional<Rational> fromDecimal(const Decimal &value);
  /// The exact value of a finite double, if it fits.
  static std::optional<Rational> fromDouble(double value);

  constexpr std::int64_t numerator() const { return numerator_; }
  constexpr std::int64_t denominator() const { return denominator_; }
  constexpr bool isInteger() const { return denominator_ == 1; }
  constexpr bool isZero() const { return numerator_ == 0; }
  constexpr bool isNegative() const { return numerator_ < 0; }
  /// The denominator is a power of two: a double can hold the value if the numerator fits it.
  constexpr bool isDyadic() const { return (denominator_ & (denominator_ - 1)) == 0; }
  /// Within one unit in the last place; exact where a double can be.
  double toDouble() const;
  /// `-3/4`, `5`
  std::string toString() const;

  friend std::strong_ordering operator<=>(const Rational &left, const Rational &right);
  friend bool operator==(const Rational &left, const Rational &right) = default;
  friend class RationalMaker;

private:
  constexpr Rational(std::int64_t numerator, std::int64_t denominator)
      : numerator_(numerator), denominator_(denominator) {}

  std::int64_t numerator_ = 0;
  std::int64_t denominator_ = 1;
};

std::optional<Rational> add(const Rational &left, const Rational &right);
std::optional<Rational> subtract(const Rational &left, const Rational &right);
std::optional<Rational> multiply(const Rational &left, const Rational &right);
/// Absent too when the divisor is 0.
std::optional<Rational> divide(const Rational &left, const Rational &right);
std::optional<Rational> negate(const Rational &value);
/// The largest g >= 0 of which both are integer multiples; 0 when both are 0.
std::optional<Rational> gcd(const Rational &left, const Rational &right);
/// left - right is step * n for a whole n; holds for fractions of any size.
bool differByMultiple(const Rational &left, const Rational &right, const Rational &step);
/// The largest integer that is not above the value.
std::int64_t floor(const Rational &value);
/// Towards zero.
std::int64_t truncate(const Rational &value);

} // namespace feedhold
