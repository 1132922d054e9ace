// Number: an exact rational of any size.  The only header that speaks GMP.
#pragma once

#include "base/support/rational.h"

#include <gmpxx.h>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace feedhold::smt {

class Number {
public:
  Number() = default;
  Number(int value) : value_(value) {}
  explicit Number(std::int64_t value);
  explicit Number(const Rational &value);
  /// `-17`, `3/4`, `0.25`, `17.0`; absent for anything else, and for a denominator of 0.
  static std::optional<Number> parse(std::string_view text);
  /// The exact value of a finite double.
  static Number fromDouble(double value);
  /// The shortest decimal that reads as this finite double: the number that was typed.
  static Number fromTyped(double value);

  bool isZero() const { return sgn(value_) == 0; }
  bool isInteger() const { return mpz_cmp_ui(value_.get_den_mpz_t(), 1) == 0; }
  /// -1, 0 or 1
  int sign() const { return sgn(value_); }
  Number numerator() const { return Number(mpq_class(value_.get_num())); }
  /// Always positive.
  Number denominator() const { return Number(mpq_class(value_.get_den())); }
  /// The nearest double: of a number that was typed, the one that reads so.
  double toDouble() const;
  /// Absent when it does not fit.
  std::optional<Rational> toRational() const;
  /// `-3/4`, `5`
  std::string toString() const { return value_.get_str(); }
  std::size_t hash() const;
  /// Machine words in it: what arithmetic with it costs.
  std::size_t words() const { return mpz_size(value_.get_num_mpz_t()) + mpz_size(value_.get_den_mpz_t()); }

  Number operator-() const { return Number(mpq_class(-value_)); }
  Number &operator+=(const Number &other) { return value_ += other.value_, *this; }
  Number &operator-=(const Number &other) { return value_ -= other.value_, *this; }
  Number &operator*=(const Number &other) { return value_ *= other.value_, *this; }
  /// The divisor is not 0.
  Number &operator/=(const Number &other);

  friend Number operator+(Number left, const Number &right) { return left += right; }
  friend Number operator-(Number left, const Number &right) { return left -= right; }
  friend Number operator*(Number left, const Number &right) { return left *= right; }
  friend Number operator/(Number left, const Number &right) { return left /= right; }
  friend bool operator==(const Number &left, const Number &right) { return left.value_ == right.value_; }
  friend std::strong_ordering operator<=>(const Number &left, const Number &right) {
    return cmp(left.value_, right.value_) <=> 0;
  }

  friend Number floor(const Number &value);
  friend Number ceiling(const Number &value);
  friend Number abs(const Number &value) { return value.sign() < 0 ? -value : value; }
  /// Of two integers: never negative; gcd(0, n) = |n|.
  friend Number gcd(const Number &left, const Number &right);
  /// Of two integers: the least common multiple, never negative.
  friend Number lcm(const Number &left, const Number &right);
  /// Present when the root is rational; the value is not negative.
  friend std::optional<Number> exactSquareRoot(const Number &value);

private:
  explicit Number(mpq_class value) : value_(std::move(value)) {}

  mpq_class value_;
};

Number floor(const Number &value);
Number ceiling(const Number &value);
Number gcd(const Number &left, const Number &right);
Number lcm(const Number &left, const Number &right);
std::optional<Number> exactSquareRoot(const Number &value);

} // namespace feedhold::smt
