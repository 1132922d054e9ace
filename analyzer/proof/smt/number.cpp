#include "proof/smt/number.h"

#include "base/support/check.h"
#include "proof/smt/steps.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>

namespace feedhold::smt {
namespace {

bool allDigits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Of an operation that needs GMP: a common divisor is sought of what comes out.
void spendOn(const Number &left, const Number &right) {
  const std::uint64_t words = left.words() + right.words();
  spend(20 + words + words * words / 8);
}

// GMP takes and gives `long`, which has 32 bits on some systems; its limbs have 64 bits, or 32 in WebAssembly.
constexpr std::size_t kLimbsOfWord = sizeof(std::uint64_t) / sizeof(mp_limb_t);
static_assert(kLimbsOfWord == 1 || kLimbsOfWord == 2);

/// Of 64 bits on every system: budgets are counted in them.
std::size_t wordsOf(mpz_srcptr integer) { return (mpz_size(integer) + kLimbsOfWord - 1) / kLimbsOfWord; }

mpz_class integerOf(std::int64_t value) {
  const std::uint64_t magnitude = value < 0 ? 0 - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
  mpz_class result;
  mpz_import(result.get_mpz_t(), 1, -1, sizeof magnitude, 0, 0, &magnitude);
  return value < 0 ? mpz_class(-result) : result;
}

/// Absent where it does not fit; the most negative value, which no Rational holds, counts among these.
std::optional<std::int64_t> narrowed(const mpz_class &value) {
  std::uint64_t word = mpz_getlimbn(value.get_mpz_t(), 0); // 0 of 0
  if (kLimbsOfWord == 2)
    word |= std::uint64_t{mpz_getlimbn(value.get_mpz_t(), 1)} << 32;
  if (wordsOf(value.get_mpz_t()) > 1 || word > std::uint64_t{std::numeric_limits<std::int64_t>::max()})
    return std::nullopt;
  return sgn(value) < 0 ? -static_cast<std::int64_t>(word) : static_cast<std::int64_t>(word);
}

} // namespace

Number::Number(std::int64_t value) {
  if (const auto small = Rational::make(value, 1)) // all but the most negative
    small_ = *small;
  else
    big_ = std::make_shared<const mpq_class>(integerOf(value));
}

Number::Number(mpq_class value) {
  const std::optional<std::int64_t> above = narrowed(value.get_num()), below = narrowed(value.get_den());
  std::optional<Rational> small;
  if (above && below)
    small = Rational::make(*above, *below);
  if (small)
    small_ = *small;
  else
    big_ = std::make_shared<const mpq_class>(std::move(value));
}

mpq_class Number::wide() const {
  if (big_)
    return *big_;
  return {integerOf(small_.numerator()), integerOf(small_.denominator())};
}

int Number::sign() const {
  if (big_)
    return sgn(*big_);
  return small_.isNegative() ? -1 : small_.isZero() ? 0 : 1;
}

Number Number::numerator() const { return big_ ? Number(mpq_class(big_->get_num())) : Number(small_.numerator()); }

Number Number::denominator() const { return big_ ? Number(mpq_class(big_->get_den())) : Number(small_.denominator()); }

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
  constexpr std::int64_t kExact = std::int64_t{1} << 53;
  if (!big_ && std::abs(small_.numerator()) <= kExact && small_.denominator() <= kExact)
    return static_cast<double>(small_.numerator()) / static_cast<double>(small_.denominator());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const mpq_class value = wide();
  const double near = value.get_d(); // cut off towards 0
  const double far = std::nextafter(near, sign() < 0 ? -kInfinity : kInfinity);
  if (!std::isfinite(far) || value == near)
    return near;
  const int side = cmp(::abs(value - mpq_class(near)), ::abs(mpq_class(far) - value));
  const bool isNearEven = (std::bit_cast<std::uint64_t>(near) & 1U) == 0;
  return side < 0 || (side == 0 && isNearEven) ? near : far;
}

std::size_t Number::hash() const {
  const auto ofAll = [](mpz_srcptr integer) {
    std::size_t hash = mpz_size(integer);
    for (std::size_t limb = 0; limb < mpz_size(integer); ++limb) // the lowest alone are 0 for all high powers of 2
      hash = hash * 0x9E3779B97F4A7C15u + mpz_getlimbn(integer, static_cast<mp_size_t>(limb));
    return hash;
  };
  const std::size_t above = big_ ? ofAll(big_->get_num_mpz_t()) : static_cast<std::size_t>(small_.numerator());
  const std::size_t below = big_ ? ofAll(big_->get_den_mpz_t()) : static_cast<std::size_t>(small_.denominator());
  return (above * 2 + (sign() < 0 ? 1 : 0)) * 0x9E3779B97F4A7C15u ^ below;
}

std::size_t Number::words() const {
  if (!big_)
    return small_.isZero() ? 1 : 2;
  return wordsOf(big_->get_num_mpz_t()) + wordsOf(big_->get_den_mpz_t());
}

Number Number::operator-() const {
  if (const auto small = big_ ? std::nullopt : negate(small_))
    return Number(*small);
  return Number(mpq_class(-wide()));
}

Number &Number::operator+=(const Number &other) {
  if (const auto small = big_ || other.big_ ? std::nullopt : add(small_, other.small_)) {
    take(small);
  } else {
    spendOn(*this, other);
    *this = Number(mpq_class(wide() + other.wide()));
  }
  return *this;
}

Number &Number::operator-=(const Number &other) {
  if (const auto small = big_ || other.big_ ? std::nullopt : subtract(small_, other.small_)) {
    take(small);
  } else {
    spendOn(*this, other);
    *this = Number(mpq_class(wide() - other.wide()));
  }
  return *this;
}

Number &Number::operator*=(const Number &other) {
  if (const auto small = big_ || other.big_ ? std::nullopt : multiply(small_, other.small_)) {
    take(small);
  } else {
    spendOn(*this, other);
    *this = Number(mpq_class(wide() * other.wide()));
  }
  return *this;
}

Number &Number::operator/=(const Number &other) {
  FEEDHOLD_CHECK(!other.isZero(), "a Number was divided by 0");
  if (const auto small = big_ || other.big_ ? std::nullopt : divide(small_, other.small_)) {
    take(small);
  } else {
    spendOn(*this, other);
    *this = Number(mpq_class(wide() / other.wide()));
  }
  return *this;
}

bool operator==(const Number &left, const Number &right) {
  if (!left.big_ && !right.big_)
    return left.small_ == right.small_;
  return left.big_ && right.big_ && *left.big_ == *right.big_;
}

std::strong_ordering operator<=>(const Number &left, const Number &right) {
  if (!left.big_ && !right.big_)
    return left.small_ <=> right.small_;
  return cmp(left.wide(), right.wide()) <=> 0;
}

Number floor(const Number &value) {
  if (!value.big_)
    return Number(floor(value.small_));
  mpz_class result;
  mpz_fdiv_q(result.get_mpz_t(), value.big_->get_num_mpz_t(), value.big_->get_den_mpz_t());
  return Number(mpq_class(result));
}

Number ceiling(const Number &value) { return -floor(-value); }

Number gcd(const Number &left, const Number &right) {
  FEEDHOLD_CHECK(left.isInteger() && right.isInteger(), "gcd of fractions");
  if (!left.big_ && !right.big_)
    return Number(std::gcd(left.small_.numerator(), right.small_.numerator()));
  return Number(mpq_class(gcd(left.wide().get_num(), right.wide().get_num())));
}

Number lcm(const Number &left, const Number &right) {
  FEEDHOLD_CHECK(left.isInteger() && right.isInteger(), "lcm of fractions");
  if (!left.big_ && !right.big_ && left.small_ == right.small_)
    return abs(left);
  return Number(mpq_class(lcm(left.wide().get_num(), right.wide().get_num())));
}

std::optional<Number> exactSquareRoot(const Number &value) {
  FEEDHOLD_CHECK(value.sign() >= 0, "the square root of a negative number");
  const mpq_class wide = value.wide();
  const mpz_class &above = wide.get_num(), &below = wide.get_den();
  if (mpz_perfect_square_p(above.get_mpz_t()) == 0 || mpz_perfect_square_p(below.get_mpz_t()) == 0)
    return std::nullopt;
  return Number(mpq_class(sqrt(above), sqrt(below)));
}

} // namespace feedhold::smt
