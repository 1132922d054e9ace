// The two results of one computation: on paper and in doubles.
#include "inference/domain/rounded_number.h"

#include <gtest/gtest.h>

namespace feedhold::laws {
namespace {

RoundedNumber literal(std::int64_t mantissa, std::uint8_t scale) {
  return *RoundedNumber::of(Decimal(mantissa, scale));
}

TEST(RoundedNumberExamples, ASumOfTenthsDiffersFromPaper) {
  const auto sum = add(literal(1, 1), literal(2, 1));
  EXPECT_EQ(sum->exact, *Rational::make(3, 10));
  EXPECT_EQ(sum->computed, 0.1 + 0.2);
  EXPECT_NE(sum->computed, literal(3, 1).computed);
  EXPECT_EQ(computedText(sum->computed), "0.30000000000000004");
  EXPECT_EQ(exactText(sum->exact), "0.3");
}

TEST(RoundedNumberExamples, HalvesAndQuartersAreExact) {
  EXPECT_TRUE(literal(1, 1).isInexact());
  EXPECT_FALSE(literal(25, 2).isInexact());
  EXPECT_FALSE(multiply(literal(25, 2), literal(5, 1))->isInexact());
  EXPECT_TRUE(divide(literal(1, 0), literal(3, 0))->isInexact());
  EXPECT_EQ(exactText(divide(literal(1, 0), literal(3, 0))->exact), "1/3");
}

TEST(RoundedNumberExamples, WholeNumbersAreCutFromEachResult) {
  const auto quotient = divide(literal(3, 1), literal(1, 1)); // 2.9999999999999996
  EXPECT_EQ(floorOf(*quotient)->exact, Rational(3));
  EXPECT_EQ(floorOf(*quotient)->computed, 2);
  EXPECT_EQ(ceilOf(literal(-25, 1))->exact, Rational(-2));
  EXPECT_EQ(ceilOf(literal(-25, 1))->computed, -2);
  EXPECT_EQ(round(literal(-25, 1))->exact, Rational(-3));
  EXPECT_EQ(round(literal(-25, 1))->computed, -3);
}

TEST(RoundedNumberExamples, RootsOfSquaresAreKnown) {
  EXPECT_EQ(squareRoot(literal(25, 2))->exact, *Rational::make(1, 2));
  EXPECT_EQ(squareRoot(literal(2, 0)), std::nullopt);
  EXPECT_EQ(squareRoot(literal(-4, 0)), std::nullopt);
}

TEST(RoundedNumberExamples, ConstantsOfTheAnalysisHaveBothResults) {
  const auto known =
      RoundedNumber::of(add(AbstractNumber::constant(Decimal(1, 1)), AbstractNumber::constant(Decimal(2, 1))));
  EXPECT_EQ(known->exact, *Rational::make(3, 10));
  EXPECT_EQ(known->computed, 0.1 + 0.2);
  EXPECT_FALSE(RoundedNumber::of(AbstractNumber::any()));
}

} // namespace
} // namespace feedhold::laws
