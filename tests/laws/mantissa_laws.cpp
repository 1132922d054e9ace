// What holds of numbers that a control with mantissas of 32 bits keeps: no model is left out, and nothing is rounded
// twice.
#include "inference/domain/mantissa_number.h"
#include "laws/domain_samples.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace feedhold::laws {
namespace {

mantissa32::Error anyError() {
  constexpr std::array kErrors = {mantissa32::Error{}, mantissa32::kErrorOfProduct, mantissa32::kErrorOfQuotient,
                                  mantissa32::kErrorOfSine, mantissa32::kErrorOfOthers};
  return kErrors[static_cast<std::size_t>(between(0, static_cast<int>(kErrors.size()) - 1))];
}

/// Of whatever is rounded, the bounds hold the values of all models.
bool mayBe(const AbstractNumber &held, double value) { return inEveryModel(held).contains(value); }

/// Multiples of a power of two stay so, so that bounds of which they are known may be nearer.
bool holdsError(const AbstractNumber &held, double value, double off) {
  const double step = held.grid().isAny() ? 0 : held.grid().step().toDouble();
  const auto mayBeNear = [&](double bound) {
    return held.interval().lo <= bound + step && bound - step <= held.interval().hi;
  };
  return mayBeNear(value + off) && mayBeNear(value - off);
}

RC_GTEST_PROP(HeldNumbers, AreThoseOfEachModel, ()) {
  const Sample sample = anySample();
  const mantissa32::Error error = anyError();
  const AbstractNumber held = heldInMantissa32(sample.number, error);
  const bool isExact = fitsMantissa32(sample.number);
  for (const double value : sample.computed) {
    RC_ASSERT(held.contains(value));
    RC_ASSERT(mayBe(held, mantissa32::nearest(value)));
    const double off = isExact ? 0 : error.relative * std::fabs(value) + error.absolute;
    RC_ASSERT(holdsError(held, value, off));
  }
  for (const Rational &value : sample.real)
    RC_ASSERT(held.containsExactly(value));
  RC_ASSERT(heldInMantissa32(held, {}) == held);
}

RC_GTEST_PROP(HeldNumbers, AreExactWhereTheyFit, ()) {
  const AbstractNumber whole = AbstractNumber::integersIn({-2147483648.0, 2147483648.0});
  const AbstractNumber quarter = AbstractNumber::constant(Decimal(between(-4000, 4000) * 25, 2));
  RC_ASSERT(heldInMantissa32(whole, anyError()).isCopyOf(whole));
  RC_ASSERT(heldInMantissa32(quarter, anyError()).isCopyOf(quarter));
  RC_ASSERT(heldInMantissa32(AbstractNumber::integersIn({0, INFINITY}), anyError()).isWhole());
}

RC_GTEST_PROP(HeldNumbers, HoldTheErrorsOfSums, ()) {
  const Sample left = simpleSample();
  const Sample right = simpleSample();
  const AbstractNumber sum = add(left.number, right.number);
  if (fitsMantissa32(sum))
    return;
  const AbstractNumber held = heldSumInMantissa32(sum, left.number.interval(), right.number.interval());
  for (const double a : left.computed)
    for (const double b : right.computed) {
      const double off = mantissa32::kErrorOfSum * std::max(std::fabs(a), std::fabs(b));
      RC_ASSERT(holdsError(held, a + b, off));
    }
}

RC_GTEST_PROP(HeldNumbers, AreEqualAsDecimals, ()) {
  const Decimal value = anyDecimal();
  const AbstractNumber number = heldInMantissa32(AbstractNumber::constant(value), {});
  RC_ASSERT(fitsMantissa32(number) || isSameDecimal(number, number) || number.isInterval() || number.isExact());
  RC_ASSERT(mayBe(number, mantissa32::nearest(value.toDouble())));
}

} // namespace
} // namespace feedhold::laws
