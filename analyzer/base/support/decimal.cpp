// Comparison and conversion of exact decimals, without overflow at any mantissa and scale.
#include "base/support/decimal.h"

#include <fmt/format.h>

#include <charconv>

namespace feedhold {

namespace {

__extension__ using Word128 = unsigned __int128;

/// The absolute value; right for INT64_MIN too, whose negation does not fit an int64.
std::uint64_t magnitude(std::int64_t value) {
  return value < 0 ? ~static_cast<std::uint64_t>(value) + 1 : static_cast<std::uint64_t>(value);
}

/// 10^19 is the largest power that fits 64 bits, and 2^63 * 10^19 still fits 128.
constexpr int kLargestPower = 19;

Word128 timesPowerOfTen(std::uint64_t value, int power) {
  Word128 product = value;
  for (int i = 0; i < power; ++i)
    product *= 10;
  return product;
}

/// Compares left * 10^-leftScale with right * 10^-rightScale where rightScale >= leftScale.
std::strong_ordering compareMagnitudes(std::uint64_t left, int leftScale, std::uint64_t right, int rightScale) {
  const int power = rightScale - leftScale;
  if (left == 0)
    return right == 0 ? std::strong_ordering::equal : std::strong_ordering::less;
  if (power > kLargestPower) // left * 10^20 is above every 64-bit number
    return std::strong_ordering::greater;
  return timesPowerOfTen(left, power) <=> Word128{right};
}

int signOf(std::int64_t value) { return (value > 0) - (value < 0); }

/// The same value with no zero at the end of its fraction.
Decimal shortest(Decimal value) {
  if (value.isZero())
    return Decimal();
  std::int64_t mantissa = value.mantissa();
  std::uint8_t scale = value.scale();
  while (scale > 0 && mantissa % 10 == 0) {
    mantissa /= 10;
    --scale;
  }
  return Decimal(mantissa, scale);
}

} // namespace

std::strong_ordering operator<=>(const Decimal &left, const Decimal &right) {
  const int sign = signOf(left.mantissa_);
  if (sign != signOf(right.mantissa_))
    return sign <=> signOf(right.mantissa_);
  const std::uint64_t l = magnitude(left.mantissa_);
  const std::uint64_t r = magnitude(right.mantissa_);
  const std::strong_ordering order = left.scale_ <= right.scale_
                                         ? compareMagnitudes(l, left.scale_, r, right.scale_)
                                         : 0 <=> compareMagnitudes(r, right.scale_, l, left.scale_);
  return sign < 0 ? 0 <=> order : order;
}

bool Decimal::isInteger() const { return shortest(*this).scale() == 0; }

std::optional<std::int64_t> Decimal::asInteger() const {
  if (scale_ == 0) // nearly every number of a variable
    return mantissa_;
  const Decimal value = shortest(*this);
  if (value.scale() != 0)
    return std::nullopt;
  return value.mantissa();
}

double Decimal::toDouble() const {
  // Up to 2^53 and 10^22 both parts are exact doubles, so that one division rounds correctly
  // (Clinger, "How to read floating point numbers accurately", 1990).
  constexpr std::uint64_t kExactMantissa = std::uint64_t{1} << 53;
  constexpr int kExactPower = 22;
  if (magnitude(mantissa_) <= kExactMantissa && scale_ <= kExactPower) {
    double power = 1;
    for (int i = 0; i < scale_; ++i)
      power *= 10;
    return static_cast<double>(mantissa_) / power;
  }
  const std::string text = fmt::format("{}e-{}", mantissa_, scale_);
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::string Decimal::toString() const {
  const Decimal value = shortest(*this);
  const std::string digits = fmt::format("{:0>{}}", magnitude(value.mantissa()), std::size_t{value.scale()} + 1);
  const std::string_view sign = value.isNegative() ? "-" : "";
  if (value.scale() == 0)
    return fmt::format("{}{}", sign, digits);
  const std::size_t point = digits.size() - value.scale();
  return fmt::format("{}{}.{}", sign, digits.substr(0, point), digits.substr(point));
}

} // namespace feedhold
