// What holds of intervals, grids and finite sets: they are lattices, and no operation loses a member.
#include "base/support/degrees.h"
#include "laws/domain_samples.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace feedhold::laws {
namespace {

/// The 80-bit result, which is nearer to the real one than any double, may be off by this much itself.
constexpr long double kErrorOfCheck = 1e-18L;

bool holds(const Interval &interval, long double value) {
  const long double slack = std::abs(value) * kErrorOfCheck + kErrorOfCheck;
  return value >= interval.lo - slack && value <= interval.hi + slack;
}

/// The double result and the real one.
void expectHolds(const Interval &interval, double computed, const std::optional<Rational> &real) {
  if (std::isfinite(computed))
    RC_ASSERT(interval.contains(computed));
  if (!real)
    return;
  const auto lo = Rational::fromDouble(interval.lo);
  const auto hi = Rational::fromDouble(interval.hi);
  RC_ASSERT((!lo || *lo <= *real));
  RC_ASSERT((!hi || *hi >= *real));
}

RC_GTEST_PROP(Intervals, HoldWhatArithmeticGives, ()) {
  const Interval left = anyInterval();
  const Interval right = anyInterval();
  const auto quotients = divide(left, right);
  const auto remainders = remainderTruncated(left, right);
  for (const double a : membersOf(left)) {
    for (const double b : membersOf(right)) {
      const auto x = Rational::fromDouble(a);
      const auto y = Rational::fromDouble(b);
      const bool fits = x && y;
      expectHolds(add(left, right), a + b, fits ? add(*x, *y) : std::nullopt);
      expectHolds(subtract(left, right), a - b, fits ? subtract(*x, *y) : std::nullopt);
      expectHolds(multiply(left, right), a * b, fits ? multiply(*x, *y) : std::nullopt);
      if (b == 0)
        continue;
      RC_ASSERT(quotients.has_value());
      RC_ASSERT(remainders.has_value());
      expectHolds(*quotients, a / b, fits ? divide(*x, *y) : std::nullopt);
      expectHolds(*remainders, std::fmod(a, b), std::nullopt);
    }
  }
}

RC_GTEST_PROP(Intervals, AreExactWhereDoublesAre, ()) {
  const double a = between(-4000, 4000) / 8.0;
  const double b = between(-4000, 4000) / 8.0;
  const Interval left = Interval::constant(a);
  const Interval right = Interval::constant(b);
  RC_ASSERT(add(left, right) == Interval::constant(a + b));
  RC_ASSERT(subtract(left, right) == Interval::constant(a - b));
  RC_ASSERT(multiply(left, right) == Interval::constant(a * b));
  RC_ASSERT(divide(multiply(left, right), right).value_or(left) == left);
  RC_ASSERT(sqrt(multiply(left, left)) == Interval::constant(std::abs(a)));
}

RC_GTEST_PROP(Intervals, HoldWhatRoundingGives, ()) {
  const Interval value = anyInterval();
  for (const double a : membersOf(value)) {
    RC_ASSERT(absolute(value).contains(std::abs(a)));
    RC_ASSERT(negate(value).contains(-a));
    RC_ASSERT(fix(value).contains(std::trunc(a)));
    RC_ASSERT(fup(value).contains(a < 0 ? std::floor(a) : std::ceil(a)));
    RC_ASSERT(floor(value).contains(std::floor(a)));
    RC_ASSERT(ceil(value).contains(std::ceil(a)));
    RC_ASSERT(roundHalfAwayFromZero(value).contains(std::round(a)));
  }
}

Interval anyAngle() {
  const double lo = between(-3000, 3000) * (between(0, 2) == 0 ? 15.0 : 0.37);
  return {lo, lo + between(0, 3) * (between(0, 2) == 0 ? 30.0 : 61.7)};
}

RC_GTEST_PROP(Intervals, HoldSinesAndTangents, ()) {
  const Interval angle = anyAngle();
  constexpr long double kRadians = std::numbers::pi_v<long double> / 180;
  for (int i = 0; i <= 8; ++i) {
    const double a = std::min(angle.hi, angle.lo + (angle.hi - angle.lo) * i / 8);
    const long double rest = std::remainder(a, 360.0) * kRadians;
    RC_ASSERT(holds(sin(angle), std::sin(rest)));
    RC_ASSERT(holds(cos(angle), std::cos(rest)));
    RC_ASSERT(sin(angle).contains(sinDegrees(a)));
    RC_ASSERT(cos(angle).contains(cosDegrees(a)));
    if (std::fmod(a, 90.0) == 0)
      continue;
    RC_ASSERT(holds(tan(angle), std::tan(rest)));
    RC_ASSERT(tan(angle).contains(tanDegrees(a)));
    // As a program that does not reduce the angle has it.
    RC_ASSERT(sin(angle).contains(std::sin(a * std::numbers::pi / 180)));
    RC_ASSERT(cos(angle).contains(std::cos(a * std::numbers::pi / 180)));
  }
}

RC_GTEST_PROP(Intervals, HoldArcs, ()) {
  const Interval y = anyInterval();
  const Interval x = anyInterval();
  constexpr long double kDegrees = 180 / std::numbers::pi_v<long double>;
  for (const double a : membersOf(y)) {
    RC_ASSERT(holds(atanDegrees(y), std::atan(static_cast<long double>(a)) * kDegrees));
    RC_ASSERT(atanDegrees(y).contains(atanDegrees(a)));
    if (std::abs(a) <= 1) {
      RC_ASSERT(holds(*asin(y), std::asin(static_cast<long double>(a)) * kDegrees));
      RC_ASSERT(holds(*acos(y), std::acos(static_cast<long double>(a)) * kDegrees));
      RC_ASSERT((asin(y)->contains(asinDegrees(a)) && acos(y)->contains(acosDegrees(a))));
    }
    for (const double b : membersOf(x)) {
      RC_ASSERT(holds(atan2Degrees(y, x), std::atan2(a + 0.0L, b + 0.0L) * kDegrees));
      RC_ASSERT(atan2Degrees(y, x).contains(atan2Degrees(a, b)));
    }
  }
}

RC_GTEST_PROP(Intervals, HoldRootsLogarithmsAndPowers, ()) {
  const Interval base = anyInterval();
  const Interval exponent = between(0, 2) == 0 ? anyInterval() : Interval::constant(between(-6, 6));
  const auto powers = pow(base, exponent);
  for (const double a : membersOf(base)) {
    const long double wide = a;
    if (a >= 0)
      RC_ASSERT((holds(*sqrt(base), std::sqrt(wide)) && sqrt(base)->contains(std::sqrt(a))));
    if (a > 0)
      RC_ASSERT((holds(*ln(base), std::log(wide)) && ln(base)->contains(std::log(a))));
    if (a < 700)
      RC_ASSERT((holds(exp(base), std::exp(wide)) && exp(base).contains(std::exp(a))));
    for (const double b : membersOf(exponent)) {
      const bool isDefined = a > 0 || (a == 0 && b >= 0) || (a < 0 && std::trunc(b) == b);
      if (!isDefined || !std::isfinite(std::pow(a, b)))
        continue;
      RC_ASSERT(powers.has_value());
      RC_ASSERT(powers->contains(std::pow(a, b)));
    }
  }
}

RC_GTEST_PROP(Intervals, FormALattice, ()) {
  const Interval left = anyInterval();
  const Interval right = anyInterval();
  const Interval either = join(left, right);
  RC_ASSERT((leq(left, left) && leq(left, either) && leq(right, either)));
  RC_ASSERT(((leq(left, right) && leq(right, left)) == (left == right)));
  const auto common = meet(left, right);
  RC_ASSERT((!common || (leq(*common, left) && leq(*common, right))));
  for (const double a : membersOf(left))
    RC_ASSERT((!right.contains(a) || (common && common->contains(a))));
  const Interval widened = widen(left, right, std::vector<double>{-5, 0, 5});
  RC_ASSERT(leq(either, widened));
  RC_ASSERT((leq(right, narrow(widened, right)) && leq(narrow(widened, right), widened)));
}

RC_GTEST_PROP(Grids, FormALattice, ()) {
  const Grid left = anyGrid();
  const Grid right = anyGrid();
  const Grid either = join(left, right);
  RC_ASSERT((leq(left, left) && leq(left, either) && leq(right, either)));
  RC_ASSERT(((leq(left, right) && leq(right, left)) == (left == right)));
  RC_ASSERT(leq(either, widen(left, right)));
  const auto common = meet(left, right);
  for (const Rational &member : membersOf(left)) {
    RC_ASSERT((left.contains(member) && either.contains(member)));
    RC_ASSERT((!right.contains(member) || (common && common->contains(member))));
  }
  for (const Rational &member : common ? membersOf(*common) : std::vector<Rational>{})
    RC_ASSERT(left.contains(member));
}

RC_GTEST_PROP(Grids, HoldWhatArithmeticGives, ()) {
  const Grid left = anyGrid();
  const Grid right = anyGrid();
  const auto expectMember = [](const Grid &grid, const std::optional<Rational> &value) {
    RC_ASSERT((!value || grid.contains(*value)));
  };
  for (const Rational &a : membersOf(left)) {
    for (const Rational &b : membersOf(right)) {
      expectMember(add(left, right), add(a, b));
      expectMember(subtract(left, right), subtract(a, b));
      expectMember(multiply(left, right), multiply(a, b));
      expectMember(divideBy(left, b), divide(a, b));
      const auto quotient = divide(a, b);
      const auto whole = quotient ? multiply(b, Rational(truncate(*quotient))) : std::nullopt;
      expectMember(remainder(left, right), whole ? subtract(a, *whole) : std::nullopt);
    }
  }
}

RC_GTEST_PROP(Grids, FindTheirNeighboursOfABound, ()) {
  const Grid grid = anyGrid();
  const Rational bound = anyRational();
  const auto above = grid.atOrAbove(bound);
  const auto below = grid.atOrBelow(bound);
  RC_ASSERT((!above || (*above >= bound && grid.contains(*above))));
  RC_ASSERT((!below || (*below <= bound && grid.contains(*below))));
  if (above && below && *above != *below)
    RC_ASSERT(subtract(*above, *below) == grid.step());
}

RC_GTEST_PROP(Grids, EndTheirWideningChains, ()) {
  Grid grid = anyGrid();
  int changes = 0;
  for (int i = 0; i < 50; ++i) {
    const Grid next = widen(grid, anyGrid());
    changes += next == grid ? 0 : 1;
    grid = next;
  }
  RC_ASSERT(changes <= 3);
}

FiniteSet anySet() {
  std::vector<double> values;
  for (int i = between(1, 11); i > 0; --i)
    values.push_back(between(-6, 7));
  return FiniteSet::of(values).value_or(FiniteSet::many());
}

RC_GTEST_PROP(FiniteSets, FormALattice, ()) {
  const FiniteSet left = anySet();
  const FiniteSet right = anySet();
  const FiniteSet either = join(left, right);
  RC_ASSERT((leq(left, left) && leq(left, either) && leq(right, either) && leq(either, widen(left, right))));
  RC_ASSERT(((leq(left, right) && leq(right, left)) == (left == right)));
  const auto common = meet(left, right);
  for (const double value : left.values()) {
    RC_ASSERT(either.contains(value));
    RC_ASSERT((right.contains(value) == (common && common->contains(value))));
  }
  RC_ASSERT(std::ranges::is_sorted(either.values()));
}

} // namespace
} // namespace feedhold::laws
