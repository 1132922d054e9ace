// Equalities that points satisfy.
#include "proof/relations/polynomials.h"

#include <gtest/gtest.h>

namespace feedhold::prove {
namespace {

using smt::Number;
using Points = std::vector<std::vector<Number>>;

Number at(const PolynomialEquality &equality, const std::vector<Number> &point) {
  Number sum;
  for (const auto &[factor, monomial] : equality) {
    Number product = factor;
    for (const std::size_t variable : monomial)
      product *= point[variable];
    sum += product;
  }
  return sum;
}

TEST(EqualitiesAt, OneLineHasOneEquality) {
  Points line;
  for (int x = 0; x < 20; ++x)
    line.push_back({Number(x), Number(3 * x + 1)});
  const auto found = equalitiesAt(line, 2);
  ASSERT_EQ(found.size(), 1u); // what follows from it is left out
  EXPECT_TRUE(at(found[0], {Number(100), Number(301)}).isZero());
  EXPECT_FALSE(at(found[0], {Number(100), Number(300)}).isZero());
}

TEST(EqualitiesAt, AProductIsFound) {
  Points quotients; // a = q b + r
  for (int b = 1; b < 8; ++b)
    for (int q = 0; q < 6; ++q)
      for (int r = 0; r < b; ++r)
        quotients.push_back({Number(q * b + r), Number(b), Number(q), Number(r)});
  const auto found = equalitiesAt(quotients, 4);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(at(found[0], {Number(123), Number(10), Number(12), Number(3)}).isZero());
  EXPECT_FALSE(at(found[0], {Number(124), Number(10), Number(12), Number(3)}).isZero());
}

TEST(EqualitiesAt, FractionsAreExact) {
  Points thirds; // y = x / 3 + 1/10
  for (int x = 0; x < 12; ++x)
    thirds.push_back({Number(x), Number(x) / Number(3) + Number(1) / Number(10)});
  const auto found = equalitiesAt(thirds, 2);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(at(found[0], {Number(1), Number(13) / Number(30)}).isZero());
}

TEST(EqualitiesAt, FewPointsShowNothing) {
  EXPECT_TRUE(equalitiesAt({{Number(1), Number(2)}, {Number(2), Number(4)}}, 2).empty());
}

TEST(EqualitiesAt, PointsWithoutOrder) {
  Points grid;
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y)
      grid.push_back({Number(x), Number(y)});
  EXPECT_TRUE(equalitiesAt(grid, 2).empty());
}

} // namespace
} // namespace feedhold::prove
