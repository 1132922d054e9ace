// Values: vacancy beside the number.
#include "inference/domain/value.h"

namespace feedhold {

namespace {

/// Of a number that one side may lack.
template <typename Combine>
AbstractNumber combined(const AbstractValue &left, const AbstractValue &right, Combine &&combine) {
  if (left.isVacant())
    return right.number();
  return right.isVacant() ? left.number() : combine(left.number(), right.number());
}

AbstractValue withVacancyOfBoth(const AbstractValue &left, const AbstractValue &right, const AbstractNumber &number) {
  if (left.isVacant() && right.isVacant())
    return left.origin() == right.origin() ? left : AbstractValue::vacant();
  const bool mayBeVacant = left.mayBeVacant() || right.mayBeVacant();
  const AbstractValue value = mayBeVacant ? AbstractValue::vacantOr(number) : AbstractValue::number(number);
  return value.withOrigin(left.origin() == right.origin() ? left.origin() : std::nullopt);
}

} // namespace

AbstractValue AbstractValue::vacant() {
  AbstractValue value;
  value.mayBeNumber_ = false;
  return value;
}

AbstractValue AbstractValue::number(AbstractNumber number) {
  AbstractValue value;
  value.number_ = std::move(number);
  value.mayBeVacant_ = false;
  return value;
}

AbstractValue AbstractValue::vacantOr(AbstractNumber number) {
  AbstractValue value;
  value.number_ = std::move(number);
  return value;
}

AbstractValue AbstractValue::withOrigin(const std::optional<Origin> &origin) const {
  AbstractValue value = *this;
  value.origin_ = origin;
  return value;
}

std::optional<AbstractValue> AbstractValue::asNumber() const {
  if (!mayBeNumber_)
    return std::nullopt;
  return number(number_).withOrigin(origin_);
}

std::optional<AbstractValue> AbstractValue::asVacant() const {
  if (!mayBeVacant_)
    return std::nullopt;
  return vacant().withOrigin(origin_);
}

AbstractValue AbstractValue::withNumber(const AbstractNumber &number) const {
  AbstractValue value = *this;
  value.number_ = number;
  return value;
}

bool leq(const AbstractValue &left, const AbstractValue &right) {
  if (left.mayBeVacant() && !right.mayBeVacant())
    return false;
  return left.isVacant() || (right.mayBeNumber() && leq(left.number(), right.number()));
}

AbstractValue join(const AbstractValue &left, const AbstractValue &right) {
  const auto joined = [](const AbstractNumber &a, const AbstractNumber &b) { return join(a, b); };
  return withVacancyOfBoth(left, right, combined(left, right, joined));
}

std::optional<AbstractValue> meet(const AbstractValue &left, const AbstractValue &right) {
  const bool mayBeVacant = left.mayBeVacant() && right.mayBeVacant();
  const bool mayBeNumber = left.mayBeNumber() && right.mayBeNumber();
  const auto number = mayBeNumber ? meet(left.number(), right.number()) : std::nullopt;
  const auto &origin = left.origin() ? left.origin() : right.origin();
  if (!number)
    return mayBeVacant ? std::optional(AbstractValue::vacant().withOrigin(origin)) : std::nullopt;
  const AbstractValue value = mayBeVacant ? AbstractValue::vacantOr(*number) : AbstractValue::number(*number);
  return value.withOrigin(origin);
}

AbstractValue widen(const AbstractValue &old, const AbstractValue &next, std::span<const double> thresholds) {
  const auto widened = [&](const AbstractNumber &a, const AbstractNumber &b) { return widen(a, b, thresholds); };
  return withVacancyOfBoth(old, next, combined(old, next, widened));
}

AbstractValue narrow(const AbstractValue &old, const AbstractValue &next) {
  if (old.isVacant() || next.isVacant())
    return next;
  return next.withNumber(narrow(old.number(), next.number()));
}

} // namespace feedhold
