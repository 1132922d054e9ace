#include "proof/smt/number.h"

#include "base/support/check.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace feedhold::smt {
namespace {

bool allDigits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

} // namespace

Number::Number(std::int64_t value) : value_(std::to_string(value)) {}

Number::Number(const Rational &value)
    : value_(std::to_string(value.numerator()) + "/" + std::to_string(value.denominator())) {}

std::optional<Number> Number::parse(std::string_view text) {
  bool negative = !text.empty() && text.front() == '-';
  if (negative)
    text.remove_prefix(1);
  std::size_t slash = text.find('/');
  std::size_t point = text.find('.');
  mpq_class value;
  if (slash != std::string_view::npos) {
    std::string_view above = text.substr(0, slash), below = text.substr(slash + 1);
    if (!allDigits(above) || !allDigits(below) || below.find_first_not_of('0') == std::string_view::npos)
      return std::nullopt;
    value = mpq_class(mpz_class(std::string(above), 10), mpz_class(std::string(below), 10));
    value.canonicalize();
  } else {
    std::string_view whole = text.substr(0, point);
    std::string_view fraction = point == std::string_view::npos ? "" : text.substr(point + 1);
    if (!allDigits(whole) || (point != std::string_view::npos && !allDigits(fraction)))
      return std::nullopt;
    mpz_class scale;
    mpz_ui_pow_ui(scale.get_mpz_t(), 10, fraction.size());
    value = mpq_class(mpz_class(std::string(whole) + std::string(fraction), 10), scale);
    value.canonicalize();
  }
  return Number(negative ? mpq_class(-value) : value);
}

Number Number::fromDouble(double value) { return Number(mpq_class(value)); }

Number Number::fromTyped(double value) {
  FEEDHOLD_CHECK(std::isfinite(value), "a number that is not finite cannot be typed");
  std::array<char, 512> digits; // 1.8e308 has 309 of them, 5e-324 has 326
  const auto end = std::to_chars(digits.begin(), digits.end(), value, std::chars_format::fixed);
  const auto typed = parse(std::string_view(digits.data(), static_cast<std::size_t>(end.ptr - digits.data())));
  FEEDHOLD_CHECK(typed.has_value(), "digits are a number");
  return *typed;
}

double Number::toDouble() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double near = value_.get_d(); // cut off towards 0
  const double far = std::nextafter(near, sign() < 0 ? -kInfinity : kInfinity);
  if (!std::isfinite(far) || value_ == near)
    return near;
  return ::abs(value_ - mpq_class(near)) <= ::abs(mpq_class(far) - value_) ? near : far;
}

std::optional<Rational> Number::toRational() const {
  const mpz_class limit("9223372036854775807");
  if (::abs(value_.get_num()) > limit || value_.get_den() > limit)
    return std::nullopt;
  return Rational::make(std::stoll(value_.get_num().get_str()), std::stoll(value_.get_den().get_str()));
}

std::size_t Number::hash() const {
  // The low limbs and the sizes: enough to tell apart the numbers of one program.
  std::size_t above = mpz_get_ui(value_.get_num_mpz_t()) * 2 + (sgn(value_) < 0 ? 1 : 0);
  return above * 0x9E3779B97F4A7C15u ^ mpz_get_ui(value_.get_den_mpz_t());
}

Number &Number::operator/=(const Number &other) {
  FEEDHOLD_CHECK(!other.isZero(), "a Number was divided by 0");
  value_ /= other.value_;
  return *this;
}

Number floor(const Number &value) {
  mpz_class result;
  mpz_fdiv_q(result.get_mpz_t(), value.value_.get_num_mpz_t(), value.value_.get_den_mpz_t());
  return Number(mpq_class(result));
}

Number ceiling(const Number &value) { return -floor(-value); }

Number gcd(const Number &left, const Number &right) {
  FEEDHOLD_CHECK(left.isInteger() && right.isInteger(), "gcd of fractions");
  return Number(mpq_class(gcd(left.value_.get_num(), right.value_.get_num())));
}

Number lcm(const Number &left, const Number &right) {
  FEEDHOLD_CHECK(left.isInteger() && right.isInteger(), "lcm of fractions");
  return Number(mpq_class(lcm(left.value_.get_num(), right.value_.get_num())));
}

std::optional<Number> exactSquareRoot(const Number &value) {
  FEEDHOLD_CHECK(value.sign() >= 0, "the square root of a negative number");
  const mpz_class above = value.value_.get_num(), below = value.value_.get_den();
  if (mpz_perfect_square_p(above.get_mpz_t()) == 0 || mpz_perfect_square_p(below.get_mpz_t()) == 0)
    return std::nullopt;
  return Number(mpq_class(sqrt(above), sqrt(below)));
}

} // namespace feedhold::smt
