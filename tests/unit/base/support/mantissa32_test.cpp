// The numbers of the 16i: exactness, order, and the errors of the table in its manual.
#include "base/support/mantissa32.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numbers>

namespace feedhold::mantissa32 {
namespace {

/// Of any size that leaves products in range.
double anyNumber() {
  const double digits = static_cast<double>(*rc::gen::inRange<std::int64_t>(-999'999'999'999, 1'000'000'000'000));
  return nearest(digits * std::pow(10.0, *rc::gen::inRange(-20, 8)));
}

TEST(Mantissa32, IsExactForWholeNumbersAndBinaryFractions) {
  for (const double value : {0.0, 1.0, -1.0, 0.25, 4294967295.0, -2147483647.0, 99999999.0, 12345678.5})
    EXPECT_EQ(nearest(value), value);
  EXPECT_EQ(nearest(4294967297.0), 4294967296.0); // 2^32 + 1: of two the even one
  EXPECT_EQ(nearest(4294967299.0), 4294967300.0);
  EXPECT_NE(nearest(0.1), 0.1);
}

TEST(Mantissa32, HasARange) {
  for (const double value : {0.0, 1e-29, -1e-29, 1e47, -1e47})
    EXPECT_TRUE(isInRange(value)) << value;
  for (const double value : {0.99e-29, -0.99e-29, 1.01e47, -1.01e47, HUGE_VAL, std::nan("")})
    EXPECT_FALSE(isInRange(value)) << value;
}

RC_GTEST_PROP(Mantissa32, RoundsOnceAndKeepsTheOrder, ()) {
  const double a = anyNumber() * *rc::gen::inRange(1, 1000) / 7;
  const double b = anyNumber() / 3;
  RC_ASSERT(nearest(nearest(a)) == nearest(a));
  RC_ASSERT(nearest(-a) == -nearest(a));
  RC_ASSERT((a <= b) == (nearest(a) <= nearest(b)) || nearest(a) == nearest(b));
  RC_ASSERT(std::fabs(nearest(a) - a) <= 0x1p-32 * std::fabs(a));
}

/// Comparisons take the sign of the rounded difference.
RC_GTEST_PROP(Mantissa32, TellsNumbersApartByTheirDifference, ()) {
  const double a = anyNumber();
  const double b = *rc::gen::inRange(0, 2) == 0 ? anyNumber() : std::nextafter(static_cast<float>(a), 0.0F);
  const double difference = nearest(a - b);
  RC_ASSERT((difference == 0) == (a == b));
  RC_ASSERT((difference > 0) == (a > b));
}

RC_GTEST_PROP(Mantissa32, StaysWithinTheErrorsOfTheManual, ()) {
  const double a = anyNumber();
  const double b = anyNumber();
  const auto error = [](long double exact) {
    return std::fabs(static_cast<long double>(nearest(static_cast<double>(exact))) - exact);
  };
  const long double left = a;
  const long double right = b;
  const long double larger = std::max(std::fabs(left), std::fabs(right));
  RC_ASSERT(error(left + right) <= 5.32e-10L * larger);
  RC_ASSERT(error(left - right) <= 5.32e-10L * larger);
  RC_ASSERT(error(left * right) <= 4.66e-10L * std::fabs(left * right));
  if (b != 0)
    RC_ASSERT(error(left / right) <= 1.88e-9L * std::fabs(left / right));
  RC_ASSERT(error(std::sqrt(std::fabs(left))) <= 3.73e-9L * std::sqrt(std::fabs(left)));
  const long double angle = std::fmod(left, 360.0L) * std::numbers::pi_v<long double> / 180;
  RC_ASSERT(error(std::sin(angle)) <= 1e-8L);
  RC_ASSERT(error(std::atan2(left, right) * 180 / std::numbers::pi_v<long double>) <= 3.6e-6L);
}

} // namespace
} // namespace feedhold::mantissa32
