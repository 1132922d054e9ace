// AbstractValue: what is known of a variable: may it be vacant, which numbers may it be, and whose copy is it.
#pragma once

#include "inference/domain/number.h"

#include <cstdint>
#include <optional>

namespace feedhold {

/// A symbol stands for one value, vacant or a number, that was fixed when the symbol was made.  A value of this origin
/// is, if it is a number, the symbol's value plus the offset; with offset 0 it is a copy, vacancy included.
struct Origin {
  std::uint32_t symbol = 0;
  Rational offset;

  friend bool operator==(const Origin &, const Origin &) = default;
};

/// May be vacant, or a number, or either; never neither.
class AbstractValue {
public:
  /// Vacant or any number.
  AbstractValue() = default;
  static AbstractValue any() { return {}; }
  static AbstractValue vacant();
  static AbstractValue anyNumber() { return number(AbstractNumber::any()); }
  static AbstractValue number(AbstractNumber number);
  static AbstractValue vacantOr(AbstractNumber number);

  bool mayBeVacant() const { return mayBeVacant_; }
  bool mayBeNumber() const { return mayBeNumber_; }
  bool isVacant() const { return !mayBeNumber_; }
  bool isNumber() const { return !mayBeVacant_; }
  /// Which number, if it is one; any() for a vacant value.
  const AbstractNumber &number() const { return number_; }
  const std::optional<Origin> &origin() const { return origin_; }

  AbstractValue withOrigin(const std::optional<Origin> &origin) const;
  /// The case that it is a number; absent when it is vacant.
  std::optional<AbstractValue> asNumber() const;
  /// The case that it is vacant; absent when it is a number.
  std::optional<AbstractValue> asVacant() const;
  /// The same vacancy and origin with another number.
  AbstractValue withNumber(const AbstractNumber &number) const;

  friend bool operator==(const AbstractValue &, const AbstractValue &) = default;

private:
  AbstractNumber number_;
  std::optional<Origin> origin_;
  bool mayBeVacant_ = true;
  bool mayBeNumber_ = true;
};

/// Without regard to origins.
bool leq(const AbstractValue &left, const AbstractValue &right);
/// The origin is kept where both have the same.
AbstractValue join(const AbstractValue &left, const AbstractValue &right);
/// The left origin, or else the right; absent when nothing is common to both.
std::optional<AbstractValue> meet(const AbstractValue &left, const AbstractValue &right);
AbstractValue widen(const AbstractValue &old, const AbstractValue &next, std::span<const double> thresholds);
AbstractValue narrow(const AbstractValue &old, const AbstractValue &next);

} // namespace feedhold
