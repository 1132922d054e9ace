// The reduction of interval, grid and set against each other.
#include "inference/domain/number_parts.h"

#include "inference/domain/number.h"
#include "inference/domain/rounding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace feedhold {

using rounding::kInfinity;

namespace {

struct Ends {
  std::optional<Rational> lo;
  std::optional<Rational> hi;
};

/// The bound itself, or one near it on the given side that fits a fraction: grids of programs are coarser than this.
std::optional<Rational> fittingBelow(double bound) {
  constexpr double kCoarse = 1 << 20;
  constexpr double kLargest = 1e12;
  if (std::abs(bound) > kLargest)
    return Rational::fromDouble(bound);
  const auto exact = Rational::fromDouble(bound);
  return exact && exact->denominator() <= std::int64_t{1} << 40
             ? exact
             : Rational::fromDouble(std::floor(bound * kCoarse) / kCoarse);
}

std::optional<Rational> fittingAbove(double bound) {
  const auto mirrored = fittingBelow(-bound);
  return mirrored ? negate(*mirrored) : std::nullopt;
}

/// The outermost members of a grid with a step inside the interval, where they can be told.
Ends endsOn(const Grid &grid, const Interval &interval) {
  const auto lo = fittingBelow(interval.lo);
  const auto hi = fittingAbove(interval.hi);
  return {lo ? grid.atOrAbove(*lo) : std::nullopt, hi ? grid.atOrBelow(*hi) : std::nullopt};
}

/// The members of a grid inside the interval, which are at most a few between the ends; many when doubles do not hold
/// one of them, absent when there is none.
std::optional<FiniteSet> membersBetween(const Grid &grid, const Rational &lo, const Rational &hi,
                                        const Interval &interval) {
  std::array<double, FiniteSet::kMost> values{};
  std::size_t count = 0;
  for (std::optional<Rational> at = lo; at && *at <= hi; at = add(*at, grid.step())) {
    const double value = at->toDouble();
    if (count == values.size() || Rational::fromDouble(value) != at)
      return FiniteSet::many();
    if (interval.contains(value))
      values[count++] = value;
  }
  return FiniteSet::of(std::span(values).first(count));
}

bool isFew(const Rational &lo, const Rational &hi, const Rational &step) {
  const auto width = subtract(hi, lo);
  const auto steps = width ? divide(*width, step) : std::nullopt;
  return steps && *steps < Rational(FiniteSet::kMost);
}

Grid gridOf(double value) {
  const auto exact = Rational::fromDouble(value);
  return exact ? Grid::constant(*exact) : Grid::any();
}

Grid gridOf(const FiniteSet &set) {
  Grid grid = gridOf(set.values().front());
  for (const double value : set.values().subspan(1))
    grid = join(grid, gridOf(value));
  return grid;
}

AbstractNumber ofSet(const FiniteSet &set) {
  return NumberParts{{set.values().front(), set.values().back()}, gridOf(set), set, Exactness::Exact}.asGiven();
}

/// Both readings have the one value of a point, whatever rounding came before.
std::optional<AbstractNumber> reducedPoint(const NumberParts &parts) {
  const double value = parts.interval.lo;
  const FiniteSet point = FiniteSet::constant(value);
  if (parts.exactness == Exactness::Exact && parts.grid.isConstant() && parts.set == point &&
      parts.grid.offset().toDouble() == value)
    return parts.asGiven(); // the sum of two constants comes this way
  const bool notReal = parts.grid.excludes(value);
  const bool notComputed = !parts.set.contains(value);
  const bool isEmpty = parts.exactness == Exactness::Exact ? notReal || notComputed : notReal && notComputed;
  if (isEmpty)
    return std::nullopt;
  return ofSet(point);
}

std::optional<AbstractNumber> reducedSet(const NumberParts &parts) {
  const auto set =
      parts.set.filter([&](double value) { return parts.interval.contains(value) && !parts.grid.excludes(value); });
  if (!set)
    return std::nullopt;
  const Interval hull{set->values().front(), set->values().back()};
  if (*set != parts.set || hull != parts.interval)
    return ofSet(*set);
  return NumberParts{hull, parts.grid.isAny() ? gridOf(*set) : parts.grid, *set, Exactness::Exact}.asGiven();
}

/// The whole numbers in the interval, without the detour over fractions.
std::optional<AbstractNumber> reducedWhole(const NumberParts &parts) {
  NumberParts tight = parts;
  tight.interval = {std::ceil(parts.interval.lo) + 0.0, std::floor(parts.interval.hi)};
  if (tight.interval.lo > tight.interval.hi)
    return std::nullopt;
  constexpr double kAllWhole = 0x1p53; // beyond, there are whole numbers between doubles
  if (tight.interval.lo < tight.interval.hi && std::max(-tight.interval.lo, tight.interval.hi) > kAllWhole)
    return tight.asGiven();
  std::array<double, FiniteSet::kMost> values{};
  std::size_t count = 0;
  for (double value = tight.interval.lo; count < values.size() && value <= tight.interval.hi; ++value)
    values[count++] = value;
  if (count == 0 || values[count - 1] != tight.interval.hi)
    return tight.asGiven();
  return ofSet(*FiniteSet::of(std::span(values).first(count)));
}

std::optional<AbstractNumber> reducedGrid(const NumberParts &parts) {
  if (parts.grid == Grid::integers())
    return reducedWhole(parts);
  NumberParts tight = parts;
  if (parts.grid.isConstant()) {
    const auto within = meet(parts.interval, Interval::of(parts.grid.offset()));
    if (!within)
      return std::nullopt;
    tight.interval = *within;
    return within->isConstant() ? ofSet(FiniteSet::constant(within->lo)) : tight.asGiven();
  }
  const Ends ends = endsOn(parts.grid, parts.interval);
  if (ends.lo && ends.hi && *ends.lo > *ends.hi)
    return std::nullopt;
  if (ends.lo)
    tight.interval.lo = std::max(tight.interval.lo, Interval::of(*ends.lo).lo);
  if (ends.hi)
    tight.interval.hi = std::min(tight.interval.hi, Interval::of(*ends.hi).hi);
  if (ends.lo && ends.hi && isFew(*ends.lo, *ends.hi, parts.grid.step())) {
    const auto members = membersBetween(parts.grid, *ends.lo, *ends.hi, parts.interval);
    if (!members)
      return std::nullopt;
    if (!members->isMany())
      return ofSet(*members);
  }
  return tight.asGiven();
}

/// Grid and set hold one arithmetic each: neither can draw the interval tighter, which holds both.
std::optional<AbstractNumber> reducedRounded(const NumberParts &parts) {
  NumberParts tight = parts;
  const auto set = parts.set.filter([&](double value) { return parts.interval.contains(value); });
  const bool noReal = parts.grid.isConstant() && !meet(parts.interval, Interval::of(parts.grid.offset()));
  if (!set && noReal)
    return std::nullopt;
  // An arithmetic in which nothing is left may say what it likes.
  if (set)
    tight.set = *set;
  return tight.asGiven();
}

} // namespace

AbstractNumber NumberParts::asGiven() const {
  NumberParts parts = *this;
  // Where neither grid nor set says anything, they hold for both arithmetics.
  if (grid.isAny() && set.isMany())
    parts.exactness = Exactness::Exact;
  AbstractNumber number;
  if (parts != AbstractNumber::kAnyParts)
    number.parts_ = std::make_shared<const NumberParts>(parts);
  return number;
}

std::optional<AbstractNumber> NumberParts::reduced() const {
  if (interval.lo > interval.hi || interval.lo == kInfinity || interval.hi == -kInfinity)
    return std::nullopt;
  if (interval.isConstant())
    return reducedPoint(*this);
  if (exactness == Exactness::Rounded)
    return reducedRounded(*this);
  if (!set.isMany())
    return reducedSet(*this);
  return grid.isAny() ? asGiven() : reducedGrid(*this);
}

AbstractNumber NumberParts::result() const {
  const auto number = reduced();
  return number ? *number : NumberParts{interval, {}, {}, Exactness::Exact}.asGiven();
}

bool fitsDoubles(const Grid &grid, const Interval &interval) {
  if (grid.isAny() || !interval.isFinite() || !grid.offset().isDyadic() || !grid.step().isDyadic())
    return false;
  constexpr double kExactIntegers = 9007199254740992.0; // 2^53
  const double finest = static_cast<double>(std::max(grid.offset().denominator(), grid.step().denominator()));
  return interval.largest() <= kExactIntegers / finest;
}

} // namespace feedhold
