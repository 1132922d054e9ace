#include "base/support/memo.h"
#include "proof/smt/ground_truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace feedhold::smt {
namespace {

constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();

/// Around the largest numbers that are kept without GMP, and small ones.
std::vector<Number> numbersOfAllSizes() {
  std::vector<Number> numbers;
  for (const std::int64_t each : {std::int64_t{0}, std::int64_t{1}, std::int64_t{-7}, std::int64_t{1} << 31, kMost - 1,
                                  kMost, -kMost, std::numeric_limits<std::int64_t>::min()})
    numbers.emplace_back(each);
  const std::size_t plain = numbers.size();
  for (std::size_t i = 0; i < plain; ++i)
    for (const std::int64_t below : {std::int64_t{3}, kMost - 2, kMost})
      numbers.push_back(numbers[i] / Number(below));
  for (std::size_t i = 0; i < plain; ++i)
    numbers.push_back(numbers[i] * numbers[i] + Number(1) / 3);
  return numbers;
}

TEST(NumberTest, LawsHoldAcrossTheBorderOfSmallNumbers) {
  const std::vector<Number> all = numbersOfAllSizes();
  for (const Number &a : all) {
    EXPECT_EQ(Number::parse(a.toString()), a);
    EXPECT_EQ(-(-a), a);
    EXPECT_EQ(a - a, Number(0));
    EXPECT_EQ(a.numerator() / a.denominator(), a);
    EXPECT_LE(floor(a), a);
    EXPECT_LT(a, floor(a) + 1);
    for (const Number &b : all) {
      EXPECT_EQ((a + b) - b, a);
      EXPECT_EQ(a + b, b + a);
      EXPECT_EQ(a < b, (a - b).sign() < 0);
      EXPECT_EQ(a == b, (a - b).isZero());
      if (a == b) {
        EXPECT_EQ(a.hash(), b.hash());
      }
      if (!b.isZero()) {
        EXPECT_EQ((a / b) * b, a);
      }
    }
  }
}

TEST(NumberTest, DoublesAreTheNearest) {
  for (const Number &a : numbersOfAllSizes()) {
    const double near = a.toDouble();
    const Number error = abs(Number::fromDouble(near) - a);
    for (const double other : {std::nextafter(near, -1e300), std::nextafter(near, 1e300)})
      EXPECT_LE(error, abs(Number::fromDouble(other) - a)) << a.toString();
  }
}

class GroundTruthTest : public testing::Test {
protected:
  TermId number(const char *text) { return store.number(*Number::parse(text)); }
  TermId root(const char *text) { return store.apply(Function::Sqrt, number(text)); }

  TermStore store;
  GroundTruth truth{store};
};

TEST_F(GroundTruthTest, DecidesWhatIsFarFromItsBound) {
  EXPECT_EQ(truth.of(store.less(root("2"), number("1.42"))), true);
  EXPECT_EQ(truth.of(store.less(root("2"), number("1.41"))), false);
  EXPECT_EQ(truth.of(store.equal(root("2"), number("1.5"))), false);
  const TermId sine = store.apply(Function::Sin, number("20"));
  EXPECT_EQ(truth.of(store.logicalAnd(store.less(number("0.34"), sine), store.less(sine, number("0.35")))), true);
  const TermId x = store.variable("x", Sort::Real);
  EXPECT_EQ(truth.of(store.logicalOr(store.less(x, number("0")), store.less(root("2"), root("3")))), true);
}

TEST_F(GroundTruthTest, LeavesOpenWhatIsNearOrNotDefined) {
  const TermId sine = store.apply(Function::Sin, number("20")), cosine = store.apply(Function::Cos, number("20"));
  const TermId one = store.add(store.multiply(sine, sine), store.multiply(cosine, cosine));
  EXPECT_EQ(truth.of(store.lessOrEqual(one, number("1"))), std::nullopt);
  EXPECT_EQ(truth.of(store.equal(one, number("1"))), std::nullopt);
  EXPECT_EQ(truth.of(store.less(root("-1"), number("5"))), std::nullopt);
  const TermId zero = store.subtract(one, number("1"));
  EXPECT_EQ(truth.of(store.less(store.divide(number("1"), zero), number("5"))), std::nullopt);
  EXPECT_EQ(truth.of(store.less(store.variable("x", Sort::Real), number("5"))), std::nullopt);
}

/// Random sums of roots and sines against long arithmetic of doubles: an answer is never wrong.
TEST_F(GroundTruthTest, AgreesWithDoublesWhereTheyAreClear) {
  std::mt19937 random(7);
  int decided = 0;
  for (int i = 0; i < 2000; ++i) {
    TermId sum = store.number(Number(0));
    double near = 0;
    for (int part = 0; part < 4; ++part) {
      const int value = static_cast<int>(random() % 700);
      const bool isRoot = random() % 2 == 0;
      const int factor = static_cast<int>(random() % 19) - 9;
      sum = store.add(
          sum, store.scale(Number(factor), store.apply(isRoot ? Function::Sqrt : Function::Sin, store.number(value))));
      near += factor * (isRoot ? std::sqrt(value) : std::sin(value * M_PI / 180));
    }
    if (std::abs(near) < 1e-6)
      continue;
    const auto found = truth.of(store.less(store.number(Number(0)), sum));
    if (found) {
      ++decided;
      EXPECT_EQ(*found, near > 0);
    }
  }
  EXPECT_GT(decided, 1900);
}

TEST(MemoTest, ForgetsAllWhenItIsFull) {
  Memo<int> memo(10);
  memo.keep("abcd", 1);
  memo.keep("efgh", 2);
  EXPECT_EQ(memo.find("abcd"), 1);
  memo.keep("ijkl", 3);
  EXPECT_EQ(memo.find("abcd"), std::nullopt);
  EXPECT_EQ(memo.find("ijkl"), 3);
}

} // namespace
} // namespace feedhold::smt
