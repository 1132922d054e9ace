// Arithmetic of 64-bit fractions by way of 128-bit products.
#include "base/support/rational.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace feedhold {

namespace {

__extension__ using Wide = __int128;

constexpr Wide kMost = std::numeric_limits<std::int64_t>::max();
// The most negative integer is left out, so that every value has a negation and a magnitude.
constexpr Wide kLeast = -kMost;

Wide magnitude(Wide value) { return value < 0 ? -value : value; }

Wide greatestCommonDivisor(Wide left, Wide right) {
  left = magnitude(left);
  right = magnitude(right);
  while (right > kMost || left > kMost) {
    if (right == 0)
      return left;
    const Wide rest = left % right;
    left = right;
    right = rest;
  }
  return std::gcd(static_cast<std::int64_t>(left), static_cast<std::int64_t>(right));
}

} // namespace

class RationalMaker {
public:
  /// In lowest terms already.
  static Rational reduced(std::int64_t numerator, std::int64_t denominator) { return Rational(numerator, denominator); }

  /// The fraction in lowest terms, if it fits.
  static std::optional<Rational> make(Wide numerator, Wide denominator) {
    if (denominator == 0)
      return std::nullopt;
    if (denominator < 0) {
      numerator = -numerator;
      denominator = -denominator;
    }
    const bool isNarrow = numerator <= kMost && numerator >= kLeast && denominator <= kMost;
    if (isNarrow && denominator != 1) { // most are, and 128-bit divisions are slow
      const auto narrowNumerator = static_cast<std::int64_t>(numerator);
      const auto narrowDenominator = static_cast<std::int64_t>(denominator);
      const std::int64_t divisor = std::gcd(narrowNumerator, narrowDenominator);
      return Rational(narrowNumerator / divisor, narrowDenominator / divisor);
    }
    if (denominator != 1) {
      const Wide divisor = greatestCommonDivisor(numerator, denominator);
      numerator /= divisor;
      denominator /= divisor;
    }
    if (numerator > kMost || numerator < kLeast || denominator > kMost)
      return std::nullopt;
    return Rational(static_cast<std::int64_t>(numerator), static_cast<std::int64_t>(denominator));
  }
};

std::optional<Rational> Rational::make(std::int64_t numerator, std::int64_t denominator) {
  return RationalMaker::make(numerator, denominator);
}

std::optional<Rational> Rational::fromDecimal(const Decimal &value) {
  constexpr int kLargestScale = 18; // 10^18 is the largest power of ten in 63 bits
  std::int64_t mantissa = value.mantissa();
  int scale = value.scale();
  for (; scale > 0 && mantissa % 10 == 0; --scale)
    mantissa /= 10;
  if (mantissa == 0)
    return Rational();
  if (scale > kLargestScale)
    return std::nullopt;
  // A power of ten has the factors 2 and 5 alone: this is the hot path of literals, and a gcd would be slow.
  const int twos = std::min(scale, std::countr_zero(static_cast<std::uint64_t>(mantissa)));
  mantissa >>= twos;
  std::int64_t power = std::int64_t{1} << (scale - twos);
  for (int fives = scale; fives > 0; --fives) {
    if (mantissa % 5 == 0)
      mantissa /= 5;
    else
      power *= 5;
  }
  return RationalMaker::reduced(mantissa, power);
}

std::optional<Rational> Rational::fromDouble(double value) {
  constexpr double kExactInteger = 9007199254740992.0; // 2^53
  if (std::abs(value) <= kExactInteger && std::trunc(value) == value)
    return Rational(static_cast<std::int64_t>(value));
  if (!std::isfinite(value))
    return std::nullopt;
  int exponent = 0;
  constexpr int kDigits = std::numeric_limits<double>::digits;
  auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), kDigits));
  exponent -= kDigits;
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
  mantissa >>= zeros;
  exponent += zeros;
  constexpr int kMostBits = 62;
  if (exponent > kMostBits || exponent < -kMostBits)
    return std::nullopt;
  if (exponent < 0)
    return RationalMaker::reduced(mantissa, std::int64_t{1} << -exponent);
  return RationalMaker::make(Wide{mantissa} * (Wide{1} << exponent), 1);
}

double Rational::toDouble() const {
  return static_cast<double>(static_cast<long double>(numerator_) / static_cast<long double>(denominator_));
}

std::string Rational::toString() const {
  return isInteger() ? fmt::format("{}", numerator_) : fmt::format("{}/{}", numerator_, denominator_);
}

std::strong_ordering operator<=>(const Rational &left, const Rational &right) {
  if (left.denominator_ == right.denominator_)
    return left.numerator_ <=> right.numerator_;
  return Wide{left.numerator_} * right.denominator_ <=> Wide{right.numerator_} * left.denominator_;
}

std::optional<Rational> add(const Rational &left, const Rational &right) {
  if (left.denominator() == right.denominator())
    return RationalMaker::make(Wide{left.numerator()} + right.numerator(), left.denominator());
  // Each product stays below 2^126, so that their sum fits.
  return RationalMaker::make(Wide{left.numerator()} * right.denominator() +
                                 Wide{right.numerator()} * left.denominator(),
                             Wide{left.denominator()} * right.denominator());
}

std::optional<Rational> subtract(const Rational &left, const Rational &right) {
  const auto negated = negate(right);
  return negated ? add(left, *negated) : std::nullopt;
}

std::optional<Rational> multiply(const Rational &left, const Rational &right) {
  return RationalMaker::make(Wide{left.numerator()} * right.numerator(),
                             Wide{left.denominator()} * right.denominator());
}

std::optional<Rational> divide(const Rational &left, const Rational &right) {
  return RationalMaker::make(Wide{left.numerator()} * right.denominator(),
                             Wide{left.denominator()} * right.numerator());
}

std::optional<Rational> negate(const Rational &value) {
  return RationalMaker::make(-Wide{value.numerator()}, value.denominator());
}

std::optional<Rational> gcd(const Rational &left, const Rational &right) {
  // Of fractions in lowest terms: gcd of the numerators over the lcm of the denominators.
  const Wide shared = greatestCommonDivisor(left.denominator(), right.denominator());
  return RationalMaker::make(greatestCommonDivisor(left.numerator(), right.numerator()),
                             Wide{left.denominator()} / shared * right.denominator());
}

bool differByMultiple(const Rational &left, const Rational &right, const Rational &step) {
  if (left == right || step.isZero())
    return left == right;
  const Wide numerator = Wide{left.numerator()} * right.denominator() - Wide{right.numerator()} * left.denominator();
  const Wide denominator = Wide{left.denominator()} * right.denominator();
  const Wide divisor = greatestCommonDivisor(numerator, denominator);
  // (n/d) / (p/q) = n q / (d p) is whole when d divides q and p divides n, both fractions being in lowest terms.
  return step.denominator() % (denominator / divisor) == 0 && numerator / divisor % step.numerator() == 0;
}

std::int64_t floor(const Rational &value) {
  const std::int64_t towardsZero = truncate(value);
  return value.isNegative() && !value.isInteger() ? towardsZero - 1 : towardsZero;
}

std::int64_t truncate(const Rational &value) { return value.numerator() / value.denominator(); }

} // namespace feedhold
