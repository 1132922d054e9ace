// RoundedNumber: what a value is on paper, and what a control computes for it in doubles.
#pragma once

#include "inference/domain/number.h"

#include <string>

namespace feedhold {

/// Both results of one computation.  Operations are absent where the exact result is no fraction of 64 bits.
struct RoundedNumber {
  Rational exact;
  double computed = 0;

  /// A literal: the nearest double.
  static std::optional<RoundedNumber> of(const Decimal &value);
  /// Of a number that is known: one value on paper, and one that is computed.
  static std::optional<RoundedNumber> of(const AbstractNumber &number);

  /// Rounding has changed it, if only because 0.1 is no binary number.
  bool isInexact() const;
};

std::optional<RoundedNumber> add(const RoundedNumber &left, const RoundedNumber &right);
std::optional<RoundedNumber> subtract(const RoundedNumber &left, const RoundedNumber &right);
std::optional<RoundedNumber> multiply(const RoundedNumber &left, const RoundedNumber &right);
std::optional<RoundedNumber> divide(const RoundedNumber &left, const RoundedNumber &right);
std::optional<RoundedNumber> negate(const RoundedNumber &value);
std::optional<RoundedNumber> absolute(const RoundedNumber &value);
/// Where the exact root is a fraction.
std::optional<RoundedNumber> squareRoot(const RoundedNumber &value);

/// To the whole number below, above, or nearest (halves away from zero).
std::optional<RoundedNumber> floorOf(const RoundedNumber &value);
std::optional<RoundedNumber> ceilOf(const RoundedNumber &value);
std::optional<RoundedNumber> round(const RoundedNumber &value);

/// `0.3`, `10/3`
std::string exactText(const Rational &value);
/// All digits: `0.30000000000000004`
std::string computedText(double value);

} // namespace feedhold
