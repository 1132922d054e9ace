// Decimal: an exact decimal number as a program writes it (`12.50` is 1250 at scale 2).
#pragma once

#include "base/support/check.h"

#include <compare>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace feedhold {

/// mantissa * 10^-scale.  Equality and order compare values: 1.0 == 1.
class Decimal {
public:
  constexpr Decimal() = default;
  constexpr Decimal(std::int64_t mantissa, std::uint8_t scale) : mantissa_(mantissa), scale_(scale) {}
  static constexpr Decimal fromInteger(std::int64_t value) { return Decimal(value, 0); }

  constexpr std::int64_t mantissa() const { return mantissa_; }
  constexpr std::uint8_t scale() const { return scale_; }

  bool isInteger() const;
  /// The value as an integer; absent when there is a fraction.
  std::optional<std::int64_t> asInteger() const;
  double toDouble() const;
  /// Shortest exact form: `12.5`, `-0.001`, `0`.
  std::string toString() const;
  constexpr bool isZero() const { return mantissa_ == 0; }
  constexpr bool isNegative() const { return mantissa_ < 0; }
  /// The mantissa is not INT64_MIN: no literal gives it (a literal has no sign), and its negation does not fit.
  constexpr Decimal negated() const {
    FEEDHOLD_CHECK(mantissa_ != std::numeric_limits<std::int64_t>::min(), "a decimal too large to be negated");
    return Decimal(-mantissa_, scale_);
  }

  friend std::strong_ordering operator<=>(const Decimal &left, const Decimal &right);
  friend bool operator==(const Decimal &left, const Decimal &right) { return (left <=> right) == 0; }

private:
  std::int64_t mantissa_ = 0;
  std::uint8_t scale_ = 0;
};

} // namespace feedhold
