// Exact and rounded results side by side.
#include "inference/domain/rounded_number.h"

#include <cmath>
#include <fmt/format.h>

namespace feedhold {
namespace {

constexpr double kLargestWhole = 9007199254740992.0; // 2^53

std::optional<RoundedNumber> paired(const std::optional<Rational> &exact, double computed) {
  return exact && std::isfinite(computed) ? std::optional(RoundedNumber{*exact, computed + 0.0}) : std::nullopt;
}

std::optional<std::int64_t> wholeRoot(std::int64_t square) {
  const auto root = static_cast<std::int64_t>(std::llround(std::sqrt(static_cast<double>(square))));
  const auto size = multiply(Rational(root), Rational(root));
  return size == Rational(square) ? std::optional(root) : std::nullopt;
}

template <typename ToWhole> std::optional<RoundedNumber> cut(std::int64_t exact, double value, ToWhole &&toWhole) {
  if (std::abs(value) >= kLargestWhole)
    return std::nullopt;
  return RoundedNumber{Rational(exact), toWhole(value) + 0.0};
}

} // namespace

std::optional<RoundedNumber> RoundedNumber::of(const Decimal &value) {
  return paired(Rational::fromDecimal(value), value.toDouble());
}

std::optional<RoundedNumber> RoundedNumber::of(const AbstractNumber &number) {
  const auto computed = number.constantValue();
  if (!computed || !number.grid().isConstant())
    return std::nullopt;
  return paired(number.grid().offset(), *computed);
}

bool RoundedNumber::isInexact() const { return Rational::fromDouble(computed) != exact; }

std::optional<RoundedNumber> add(const RoundedNumber &left, const RoundedNumber &right) {
  return paired(add(left.exact, right.exact), left.computed + right.computed);
}

std::optional<RoundedNumber> subtract(const RoundedNumber &left, const RoundedNumber &right) {
  return paired(subtract(left.exact, right.exact), left.computed - right.computed);
}

std::optional<RoundedNumber> multiply(const RoundedNumber &left, const RoundedNumber &right) {
  return paired(multiply(left.exact, right.exact), left.computed * right.computed);
}

std::optional<RoundedNumber> divide(const RoundedNumber &left, const RoundedNumber &right) {
  if (right.computed == 0)
    return std::nullopt;
  return paired(divide(left.exact, right.exact), left.computed / right.computed);
}

std::optional<RoundedNumber> negate(const RoundedNumber &value) { return paired(negate(value.exact), -value.computed); }

std::optional<RoundedNumber> absolute(const RoundedNumber &value) {
  return paired(value.exact.isNegative() ? negate(value.exact) : value.exact, std::abs(value.computed));
}

std::optional<RoundedNumber> squareRoot(const RoundedNumber &value) {
  if (value.exact.isNegative() || value.computed < 0)
    return std::nullopt;
  const auto numerator = wholeRoot(value.exact.numerator());
  const auto denominator = wholeRoot(value.exact.denominator());
  return numerator && denominator ? paired(Rational::make(*numerator, *denominator), std::sqrt(value.computed))
                                  : std::nullopt;
}

std::optional<RoundedNumber> floorOf(const RoundedNumber &value) {
  return cut(floor(value.exact), value.computed, [](double number) { return std::floor(number); });
}

std::optional<RoundedNumber> ceilOf(const RoundedNumber &value) {
  const auto mirrored = negate(value);
  const auto below = mirrored ? floorOf(*mirrored) : std::nullopt;
  return below ? negate(*below) : std::nullopt;
}

std::optional<RoundedNumber> round(const RoundedNumber &value) {
  const auto half = Rational::make(1, 2);
  const auto size = absolute(value);
  const auto shifted = size && half ? add(size->exact, *half) : std::nullopt;
  if (!shifted)
    return std::nullopt;
  const std::int64_t whole = floor(*shifted);
  return cut(value.exact.isNegative() ? -whole : whole, value.computed,
             [](double number) { return std::round(number); });
}

std::string exactText(const Rational &value) {
  constexpr std::int64_t kMostDecimals = 1'000'000'000;
  return kMostDecimals % value.denominator() == 0 ? fmt::format("{}", value.toDouble()) : value.toString();
}

std::string computedText(double value) { return fmt::format("{:.17g}", value); }

} // namespace feedhold
