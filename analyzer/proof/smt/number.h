// Number: an exact rational of any size.  The only header that speaks GMP.  Most numbers are small, and are kept
// without it: its allocations would take a third of the time of a proof.
#pragma once

#include "base/support/rational.h"

#include <gmpxx.h>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace feedhold::smt {

class Number {
public:
  Number() = default;
  Number(int value) : small_(value) {}
  explicit Number(std::int64_t value);
  explicit Number(const Rational &value) : small_(value) {}
  /// `-17`, `3/4`, `0.25`, `17.0`; absent for anything else, and for a denominator of 0.
  static std::optional<Number> parse(std::string_view text);
  /// The exact value of a finite double.
  static Number fromDouble(double value);
  /// The shortest decimal that reads as this finite double: the number that was typed.
  static Number fromTyped(double value);

  bool isZero() const { return !big_ && small_.isZero(); }
  bool isInteger() const { return big_ ? mpz_cmp_ui(big_->get_den_mpz_t(), 1) == 0 : small_.isInteger(); }
  /// -1, 0 or 1
  int sign() const;
  Number numerator() const;
  /// Always positive.
  Number denominator() const;
  /// The nearest double: of a number that was typed, the one that reads so.
  double toDouble() const;
  /// Absent when it does not fit.
  std::optional<Rational> toRational() const { return big_ ? std::nullopt : std::optional(small_); }
  /// `-3/4`, `5`
  std::string toString() const { return big_ ? big_->get_str() : small_.toString(); }
  std::size_t hash() const;
  /// Machine words in it: what arithmetic with it costs.
  std::size_t words() const;

  Number operator-() const;
  Number &operator+=(const Number &other);
  Number &operator-=(const Number &other);
  Number &operator*=(const Number &other);
  /// The divisor is not 0.
  Number &operator/=(const Number &other);

  friend Number operator+(Number left, const Number &right) { return left += right; }
  friend Number operator-(Number left, const Number &right) { return left -= right; }
  friend Number operator*(Number left, const Number &right) { return left *= right; }
  friend Number operator/(Number left, const Number &right) { return left /= right; }
  friend bool operator==(const Number &left, const Number &right);
  friend std::strong_ordering operator<=>(const Number &left, const Number &right);

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
  explicit Number(mpq_class value);

  mpq_class wide() const;
  void take(const std::optional<Rational> &small) {
    small_ = *small;
    big_.reset();
  }

  Rational small_;                       ///< where there is no big one
  std::shared_ptr<const mpq_class> big_; ///< what does not fit the small one
};

Number floor(const Number &value);
Number ceiling(const Number &value);
Number gcd(const Number &left, const Number &right);
Number lcm(const Number &left, const Number &right);
std::optional<Number> exactSquareRoot(const Number &value);

} // namespace feedhold::smt
