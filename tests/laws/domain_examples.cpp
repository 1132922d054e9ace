// What the lattices must not lose: the precision that programs of the field need.
#include "base/support/degrees.h"
#include "base/support/truth.h"
#include "inference/domain/number.h"

#include <gtest/gtest.h>

#include <cmath>

namespace feedhold::laws {
namespace {

AbstractNumber decimal(std::int64_t mantissa, std::uint8_t scale) {
  return AbstractNumber::constant(Decimal(mantissa, scale));
}

AbstractNumber joinOf(std::initializer_list<double> values) {
  AbstractNumber number = AbstractNumber::constant(*values.begin());
  for (const double value : values)
    number = join(number, AbstractNumber::constant(value));
  return number;
}

TEST(AbstractNumberExamples, ConstantsStayConstants) {
  const AbstractNumber sum = add(decimal(1, 1), decimal(2, 1));
  EXPECT_EQ(sum.constantValue(), 0.1 + 0.2);
  EXPECT_EQ(sum.grid(), Grid::constant(*Rational::make(3, 10)));
  EXPECT_FALSE(sum.isExact());
  EXPECT_EQ(add(decimal(125, 3), decimal(375, 3)), AbstractNumber::constant(0.5));
  EXPECT_EQ(divide(AbstractNumber::constant(7), AbstractNumber::constant(2)), AbstractNumber::constant(3.5));
}

TEST(AbstractNumberExamples, ALiteralEqualsItself) {
  EXPECT_EQ(isEqual(decimal(1, 1), decimal(10, 2)), Truth::True);
  EXPECT_EQ(isEqual(decimal(1, 1), decimal(2, 1)), Truth::False);
  // Exactly equal, though not in doubles: a control may say either.
  EXPECT_EQ(isEqual(add(decimal(1, 1), decimal(2, 1)), decimal(3, 1)), Truth::Maybe);
}

TEST(AbstractNumberExamples, WholeNumbersBelowABoundEndBeforeIt) {
  const AbstractNumber counter = AbstractNumber::integersIn({0, 100});
  EXPECT_EQ(meetLess(counter, 50)->interval(), (Interval{0, 49}));
  EXPECT_EQ(meetGreater(counter, 49.5)->interval(), (Interval{50, 100}));
  EXPECT_EQ(remove(counter, 0)->interval(), (Interval{1, 100}));
  EXPECT_EQ(remove(counter, 7), counter);
  EXPECT_EQ(meetLess(counter, 0), std::nullopt);
}

TEST(AbstractNumberExamples, WholeNumbersLieBetweenLargeDoubles) {
  constexpr std::int64_t kAllWhole = std::int64_t{1} << 53;
  const AbstractNumber number = AbstractNumber::integersIn({0x1p53 + 2, 0x1p53 + 4});
  EXPECT_TRUE(number.containsExactly(Rational(kAllWhole + 3)));
}

TEST(AbstractNumberExamples, ACounterKeepsItsStep) {
  const AbstractNumber second = widen(AbstractNumber::constant(10), joinOf({10, 9.5}), {});
  EXPECT_EQ(second, joinOf({10, 9.5}));
  const AbstractNumber counter = widen(second, joinOf({10, 9.5, 9}), {});
  EXPECT_EQ(counter.interval(), Interval::atMost(10));
  EXPECT_EQ(counter.grid(), Grid::of(*Rational::make(1, 2), Rational()));
  EXPECT_EQ(meetGreater(counter, 0)->interval(), (Interval{0.5, 10}));
  EXPECT_FALSE(subtract(counter, AbstractNumber::constant(0.5)).isExact()); // it may be of any size
  const AbstractNumber inside = *meetAtLeast(counter, 0);
  EXPECT_EQ(subtract(inside, AbstractNumber::constant(0.5)).interval(), (Interval{-0.5, 9.5}));
  EXPECT_TRUE(subtract(inside, AbstractNumber::constant(0.5)).isExact());
}

TEST(AbstractNumberExamples, FewValuesAreKeptOneByOne) {
  const AbstractNumber choice = joinOf({1, 2, 10});
  EXPECT_EQ(choice.set().values().size(), 3U);
  EXPECT_EQ(remove(choice, 10)->interval(), (Interval{1, 2}));
  EXPECT_EQ(meetGreater(choice, 2), AbstractNumber::constant(10));
  EXPECT_EQ(isEqual(choice, AbstractNumber::constant(3)), Truth::False);
  EXPECT_EQ(meet(choice, AbstractNumber::integersIn({2, 9})), AbstractNumber::constant(2));
  EXPECT_EQ(remove(AbstractNumber::constant(1), 1), std::nullopt);
}

TEST(AbstractNumberExamples, RoundingOfAnInexactQuotientIsEither) {
  const AbstractNumber tenth = decimal(1, 1);
  const AbstractNumber quotient = *divide(decimal(3, 1), tenth);
  EXPECT_EQ(fix(quotient).interval(), (Interval{2, 3}));
  EXPECT_TRUE(fix(quotient).isWhole());
  EXPECT_EQ(fup(AbstractNumber::constant(2.5)), AbstractNumber::constant(3));
  EXPECT_EQ(fix(*divide(AbstractNumber::constant(30), AbstractNumber::constant(10))), AbstractNumber::constant(3));
}

TEST(AbstractNumberExamples, RemaindersAreBelowTheirDivisor) {
  const AbstractNumber rest = *remainderTruncated(AbstractNumber::integersIn({0, 1000}), AbstractNumber::constant(4));
  EXPECT_LE(rest.interval().hi, 4);
  EXPECT_EQ(remainderTruncated(AbstractNumber::constant(7), AbstractNumber::constant(4)), AbstractNumber::constant(3));
  EXPECT_EQ(remainderTruncated(AbstractNumber::constant(7), AbstractNumber::constant(0)), std::nullopt);
}

TEST(IntervalExamples, DivisionKeepsAwayFromZero) {
  EXPECT_EQ(divide(Interval{1, 2}, Interval{0, 4}), Interval::atLeast(0.25));
  EXPECT_EQ(divide(Interval{1, 2}, Interval{0, 0}), std::nullopt);
  EXPECT_EQ(divide(Interval{-6, 6}, Interval{2, 3}), (Interval{-3, 3}));
}

TEST(IntervalExamples, AnglesAreExactAtQuarterTurns) {
  EXPECT_EQ(sin(Interval::constant(180)), Interval::constant(0));
  EXPECT_EQ(cos(Interval::constant(-90)), Interval::constant(0));
  EXPECT_EQ(sin(Interval{0, 180}), (Interval{0, 1}));
  EXPECT_EQ(cos(Interval{-90, 90}), (Interval{0, 1}));
  EXPECT_EQ(sin(Interval{1, 400}), (Interval{-1, 1}));
  EXPECT_TRUE(sin(Interval::constant(30)).contains(0.5));
  EXPECT_LT(sin(Interval::constant(30)).width(), 1e-14);
  EXPECT_EQ(tan(Interval{80, 100}), Interval::all());
  EXPECT_EQ(atan2Degrees(Interval::constant(0), Interval::constant(-1)), Interval::constant(180));
  EXPECT_EQ(asin(Interval{2, 3}), std::nullopt);
  EXPECT_EQ(acos(Interval{-5, 5}), (Interval{0, 180}));
}

TEST(IntervalExamples, PowersAreExactForWholeNumbers) {
  EXPECT_EQ(pow(Interval::constant(2), Interval::constant(10)), Interval::constant(1024));
  EXPECT_EQ(pow(Interval::constant(-3), Interval::constant(3)), Interval::constant(-27));
  EXPECT_EQ(pow(Interval::constant(-8), Interval::constant(0.5)), std::nullopt);
  EXPECT_EQ(pow(Interval::constant(2), Interval::constant(-2)), Interval::constant(0.25));
}

TEST(IntervalExamples, BoundsThatGrowGoToThresholds) {
  const std::vector<double> thresholds{-10, 0, 10};
  EXPECT_EQ(widen(Interval{1, 2}, Interval{1, 3}, thresholds), (Interval{1, 10}));
  EXPECT_EQ(widen(Interval{1, 2}, Interval{-1, 30}, thresholds), Interval::atLeast(-10));
  EXPECT_EQ(narrow(Interval::atLeast(-10), Interval{-3, 7}), (Interval{-10, 7}));
}

TEST(GridExamples, StepsMeetInTheirCommonMembers) {
  const Grid threes = Grid::of(Rational(3), Rational(1));
  const Grid fives = Grid::of(Rational(5), Rational(2));
  EXPECT_EQ(meet(threes, fives), Grid::of(Rational(15), Rational(7)));
  EXPECT_EQ(join(threes, fives), Grid::integers());
  EXPECT_EQ(meet(Grid::of(Rational(2), Rational(0)), Grid::of(Rational(2), Rational(1))), std::nullopt);
  EXPECT_TRUE(threes.contains(9.9999999, 1e-6) && !threes.contains(9.9, 1e-6));
}

TEST(Degrees, AreExactWhereRadiansAreNot) {
  EXPECT_EQ(sinDegrees(180), 0);
  EXPECT_EQ(cosDegrees(270), 0);
  EXPECT_EQ(sinDegrees(-90), -1);
  EXPECT_EQ(sinDegrees(360e6 + 90), 1);
  EXPECT_EQ(tanDegrees(45), 1);
  EXPECT_EQ(tanDegrees(135), -1);
  EXPECT_TRUE(std::isinf(tanDegrees(90)));
  EXPECT_EQ(atan2Degrees(-0.0, -1), 180);
  EXPECT_EQ(atan2Degrees(0, 0), 0);
}

TEST(Truths, CombineAsPossibleOutcomes) {
  static_assert(conjunction(Truth::Maybe, Truth::False) == Truth::False);
  static_assert(disjunction(Truth::Maybe, Truth::True) == Truth::True);
  static_assert(negate(Truth::Maybe) == Truth::Maybe && negate(Truth::True) == Truth::False);
  EXPECT_EQ(join(Truth::True, Truth::False), Truth::Maybe);
}

} // namespace
} // namespace feedhold::laws
