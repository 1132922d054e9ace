// Decimal: comparison and conversion, also where 64 bits do not suffice.
#include "base/support/decimal.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <limits>

namespace feedhold {
namespace {

__extension__ using Wide = __int128;

constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();

Wide tenTo(int power) { return power == 0 ? Wide{1} : 10 * tenTo(power - 1); }

TEST(Decimal, TrailingZerosDoNotCount) {
  EXPECT_EQ(Decimal(10, 1), Decimal(1, 0));
  EXPECT_EQ(Decimal(0, 7), Decimal());
  EXPECT_EQ(Decimal(-1250, 2), Decimal(-125, 1));
  EXPECT_NE(Decimal(1, 1), Decimal(1, 0));
}

TEST(Decimal, OrdersAtTheEdgesOfItsRange) {
  EXPECT_LT(Decimal(kMin, 0), Decimal(kMin, 1));
  EXPECT_LT(Decimal(kMin, 0), Decimal(-kMax, 0));
  EXPECT_GT(Decimal(kMax, 0), Decimal(kMax, 255));
  EXPECT_LT(Decimal(kMin, 0), Decimal(kMin, 255));
  EXPECT_GT(Decimal(1, 0), Decimal(kMax, 255));
  EXPECT_GT(Decimal(1, 0), Decimal(kMax, 19));
  EXPECT_LT(Decimal(kMin, 255), Decimal(0, 0));
  EXPECT_EQ(Decimal(0, 255), Decimal(0, 0));
}

TEST(Decimal, ComparesLikeExactArithmetic) {
  EXPECT_TRUE(rc::check("order is the order of the values", [](std::int64_t a, std::int64_t b) {
    const auto aScale = *rc::gen::inRange<int>(0, 19);
    const auto bScale = *rc::gen::inRange<int>(0, 19);
    const Wide left = Wide{a} * tenTo(18 - aScale);
    const Wide right = Wide{b} * tenTo(18 - bScale);
    const Decimal x(a, static_cast<std::uint8_t>(aScale));
    const Decimal y(b, static_cast<std::uint8_t>(bScale));
    RC_ASSERT((x < y) == (left < right));
    RC_ASSERT((x == y) == (left == right));
  }));
}

TEST(Decimal, EqualValuesAtTwoScalesAreEqual) {
  EXPECT_TRUE(rc::check("appending zeros changes nothing", [] {
    const auto mantissa = *rc::gen::inRange<std::int64_t>(-1'000'000, 1'000'001);
    const auto scale = *rc::gen::inRange<int>(0, 20);
    const auto zeros = *rc::gen::inRange<int>(0, 12);
    const Decimal shorter(mantissa, static_cast<std::uint8_t>(scale));
    const Decimal longer(mantissa * static_cast<std::int64_t>(tenTo(zeros)), static_cast<std::uint8_t>(scale + zeros));
    RC_ASSERT(shorter == longer);
    RC_ASSERT(shorter.toString() == longer.toString());
    RC_ASSERT(shorter.toDouble() == longer.toDouble());
  }));
}

TEST(Decimal, KnowsIntegers) {
  EXPECT_TRUE(Decimal(1000, 3).isInteger());
  EXPECT_EQ(Decimal(1000, 3).asInteger(), 1);
  EXPECT_EQ(Decimal(-50, 1).asInteger(), -5);
  EXPECT_EQ(Decimal(0, 200).asInteger(), 0);
  EXPECT_EQ(Decimal(kMin, 0).asInteger(), kMin);
  EXPECT_FALSE(Decimal(1001, 3).isInteger());
  EXPECT_EQ(Decimal(1001, 3).asInteger(), std::nullopt);
}

TEST(Decimal, PrintsTheShortestExactForm) {
  EXPECT_EQ(Decimal(1250, 2).toString(), "12.5");
  EXPECT_EQ(Decimal(-1, 3).toString(), "-0.001");
  EXPECT_EQ(Decimal(0, 4).toString(), "0");
  EXPECT_EQ(Decimal(100, 0).toString(), "100");
  EXPECT_EQ(Decimal(kMin, 0).toString(), "-9223372036854775808");
  EXPECT_EQ(Decimal(kMin, 19).toString(), "-0.9223372036854775808");
}

TEST(Decimal, GivesTheNearestDouble) {
  EXPECT_EQ(Decimal(1, 1).toDouble(), 0.1);
  EXPECT_EQ(Decimal(-12345, 4).toDouble(), -1.2345);
  EXPECT_EQ(Decimal(kMax, 0).toDouble(), 9223372036854775807.0);
  EXPECT_EQ(Decimal(1234567890123456789, 18).toDouble(), 1.234567890123456789);
  EXPECT_EQ(Decimal(5, 255).toDouble(), 5e-255);
}

TEST(Decimal, Negates) {
  EXPECT_EQ(Decimal(125, 1).negated(), Decimal(-125, 1));
  EXPECT_DEATH(static_cast<void>(Decimal(kMin, 0).negated()), "too large to be negated");
}

} // namespace
} // namespace feedhold
