#include "base/support/rational.h"

#include <gtest/gtest.h>

#include <limits>

namespace feedhold {
namespace {

Rational fraction(std::int64_t numerator, std::int64_t denominator) { return *Rational::make(numerator, denominator); }

constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();

TEST(Rational, IsInLowestTermsWithAPositiveDenominator) {
  EXPECT_EQ(fraction(6, -4).toString(), "-3/2");
  EXPECT_EQ(fraction(0, -7), Rational());
  EXPECT_EQ(fraction(8, 4).toString(), "2");
  EXPECT_FALSE(Rational::make(1, 0).has_value());
}

TEST(Rational, TakesDecimalsExactly) {
  EXPECT_EQ(Rational::fromDecimal(Decimal(125, 3)), fraction(1, 8));
  EXPECT_EQ(Rational::fromDecimal(Decimal(-1, 18)), fraction(-1, 1000000000000000000));
  EXPECT_EQ(Rational::fromDecimal(Decimal(10, 20)), std::nullopt);
  EXPECT_EQ(Rational::fromDecimal(Decimal(0, 30)), Rational());
}

TEST(Rational, TakesDoublesExactlyOrNotAtAll) {
  EXPECT_EQ(Rational::fromDouble(-0.375), fraction(-3, 8));
  EXPECT_EQ(Rational::fromDouble(0.1), fraction(3602879701896397, 36028797018963968));
  EXPECT_EQ(Rational::fromDouble(0x1p62), Rational(std::int64_t{1} << 62));
  EXPECT_EQ(Rational::fromDouble(0x1p63), std::nullopt);
  EXPECT_EQ(Rational::fromDouble(1e-300), std::nullopt);
  EXPECT_EQ(Rational::fromDouble(std::numeric_limits<double>::infinity()), std::nullopt);
  EXPECT_EQ(Rational::fromDouble(std::numeric_limits<double>::quiet_NaN()), std::nullopt);
}

TEST(Rational, ComputesExactly) {
  EXPECT_EQ(add(fraction(1, 10), fraction(2, 10)), fraction(3, 10));
  EXPECT_EQ(subtract(fraction(1, 3), fraction(1, 2)), fraction(-1, 6));
  EXPECT_EQ(multiply(fraction(2, 3), fraction(9, 4)), fraction(3, 2));
  EXPECT_EQ(divide(fraction(1, 3), fraction(-2, 3)), fraction(-1, 2));
  EXPECT_EQ(divide(fraction(1, 3), Rational()), std::nullopt);
}

TEST(Rational, IsAbsentWhereItDoesNotFit) {
  EXPECT_EQ(add(Rational(kMost), Rational(1)), std::nullopt);
  EXPECT_EQ(multiply(Rational(kMost), Rational(2)), std::nullopt);
  EXPECT_EQ(add(fraction(1, kMost), fraction(1, kMost - 1)), std::nullopt);
  EXPECT_EQ(multiply(Rational(kMost), fraction(1, kMost)), Rational(1));
  EXPECT_EQ(negate(Rational(std::numeric_limits<std::int64_t>::min())), std::nullopt);
}

TEST(Rational, FindsTheLargestCommonStep) {
  EXPECT_EQ(gcd(fraction(1, 4), fraction(1, 6)), fraction(1, 12));
  EXPECT_EQ(gcd(fraction(-3, 2), Rational(6)), fraction(3, 2));
  EXPECT_EQ(gcd(Rational(), fraction(-2, 5)), fraction(2, 5));
  EXPECT_EQ(gcd(Rational(), Rational()), Rational());
}

TEST(Rational, RoundsToIntegers) {
  EXPECT_EQ(floor(fraction(-3, 2)), -2);
  EXPECT_EQ(floor(Rational(-2)), -2);
  EXPECT_EQ(floor(fraction(3, 2)), 1);
  EXPECT_EQ(truncate(fraction(-3, 2)), -1);
}

TEST(Rational, OrdersByValue) {
  EXPECT_LT(fraction(1, 3), fraction(1, 2));
  EXPECT_LT(fraction(-1, 2), fraction(-1, 3));
  EXPECT_LT(fraction(kMost - 1, kMost), fraction(kMost, kMost - 1));
}

} // namespace
} // namespace feedhold
