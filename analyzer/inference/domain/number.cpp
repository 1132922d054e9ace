// Numbers: construction, the order, and what a comparison leaves of them.
#include "inference/domain/number.h"

#include "inference/domain/rounding.h"

#include <algorithm>
#include <cmath>

namespace feedhold {

namespace {

/// Of two numbers of the same exactness.
std::optional<AbstractNumber> meetOfAlike(const NumberParts &left, const NumberParts &right, const Interval &interval) {
  const auto grid = meet(left.grid, right.grid);
  const auto set = meet(left.set, right.set);
  const bool isExact = left.exactness == Exactness::Exact;
  if (isExact ? !grid || !set : !grid && !set)
    return std::nullopt;
  return NumberParts{interval, grid.value_or(left.grid), set.value_or(left.set), left.exactness}.reduced();
}

/// The exact number speaks of both arithmetics: it is kept, unless the other leaves nothing of either.
std::optional<AbstractNumber> meetOfMixed(const NumberParts &exact, const NumberParts &rounded,
                                          const Interval &interval) {
  const auto common = meet(exact.set, rounded.set);
  const bool isReal = meet(exact.grid, rounded.grid).has_value();
  const bool isComputed = common && common->filter([&](double value) { return !exact.grid.excludes(value); });
  if (!isReal && !isComputed)
    return std::nullopt;
  return NumberParts{interval, exact.grid, exact.set, Exactness::Exact}.reduced();
}

std::optional<AbstractNumber> within(const AbstractNumber &value, const Interval &bounds) {
  if (bounds.contains(value.interval()))
    return value;
  NumberParts parts = value.parts();
  const auto interval = meet(parts.interval, bounds);
  if (!interval)
    return std::nullopt;
  parts.interval = *interval;
  return parts.reduced();
}

bool isRealConstant(const AbstractNumber &value, const Rational &taken) {
  return value.grid().isConstant() && value.grid().offset() == taken;
}

/// Without one member of a grid that is an end of the interval.
std::optional<AbstractNumber> withoutEnd(const AbstractNumber &value, const Rational &taken, double end) {
  NumberParts parts = value.parts();
  if (parts.grid.isAny() || !parts.grid.contains(taken))
    return value;
  const bool isLow = parts.interval.lo == end;
  const auto next = isLow ? add(taken, parts.grid.step()) : subtract(taken, parts.grid.step());
  if (!next)
    return value;
  if (isLow)
    parts.interval.lo = Interval::of(*next).lo;
  else
    parts.interval.hi = Interval::of(*next).hi;
  return parts.reduced();
}

/// Every member is known, and on the grid.
bool isOn(const Grid &grid, const FiniteSet &set) {
  return !set.isMany() && std::ranges::all_of(set.values(), [&](double value) {
    const auto exact = Rational::fromDouble(value);
    return exact && grid.contains(*exact);
  });
}

std::partial_ordering compare(const Rational &value, double bound) {
  if (const auto exact = Rational::fromDouble(bound))
    return value <=> *exact;
  // Such a bound is infinite, or far from what fractions hold.
  return static_cast<long double>(value.numerator()) / static_cast<long double>(value.denominator()) <=>
         static_cast<long double>(bound);
}

enum class Relation { Equal, Less, AtMost };

bool holds(Relation relation, std::partial_ordering order) {
  switch (relation) {
  case Relation::Equal: return order == 0;
  case Relation::Less: return order < 0;
  case Relation::AtMost: return order <= 0;
  }
  return false;
}

Truth ofIntervals(Relation relation, const Interval &left, const Interval &right) {
  switch (relation) {
  case Relation::Equal: return left.lo > right.hi || left.hi < right.lo ? Truth::False : Truth::Maybe;
  case Relation::Less: return left.hi < right.lo ? Truth::True : left.lo >= right.hi ? Truth::False : Truth::Maybe;
  case Relation::AtMost: return left.hi <= right.lo ? Truth::True : left.lo > right.hi ? Truth::False : Truth::Maybe;
  }
  return Truth::Maybe;
}

Truth ofSets(Relation relation, const FiniteSet &left, const FiniteSet &right) {
  if (left.isMany() || right.isMany())
    return Truth::Maybe;
  std::optional<Truth> result;
  for (const double first : left.values()) {
    for (const double second : right.values()) {
      const Truth truth = truthOf(holds(relation, first <=> second));
      result = result ? join(*result, truth) : truth;
    }
  }
  return *result;
}

Truth ofGrids(Relation relation, const Grid &left, const Grid &right) {
  if (left.isConstant() && right.isConstant())
    return truthOf(holds(relation, left.offset() <=> right.offset()));
  return relation == Relation::Equal && !meet(left, right) ? Truth::False : Truth::Maybe;
}

/// The other outcome is impossible in one of the parts.
Truth sharper(Truth first, Truth second) { return first == Truth::Maybe ? second : first; }

Truth compare(Relation relation, const AbstractNumber &left, const AbstractNumber &right) {
  const Truth known = ofIntervals(relation, left.interval(), right.interval());
  if (known != Truth::Maybe)
    return known;
  const Truth computed = ofSets(relation, left.set(), right.set());
  const Truth real = ofGrids(relation, left.grid(), right.grid());
  return both(left, right) == Exactness::Exact ? sharper(computed, real) : join(computed, real);
}

} // namespace

AbstractNumber AbstractNumber::constant(const Decimal &value) {
  constexpr std::int64_t kExactIntegers = std::int64_t{1} << 53;
  const double rounded = value.toDouble();
  const auto real = Rational::fromDecimal(value);
  const FiniteSet set = FiniteSet::constant(rounded);
  if (real && real->isDyadic() && real->numerator() <= kExactIntegers && real->numerator() >= -kExactIntegers)
    return NumberParts{Interval::constant(rounded), Grid::constant(*real), set, Exactness::Exact}.asGiven();
  const rounding::Bounds bounds = rounding::around(rounded);
  return NumberParts{{bounds.down, bounds.up}, real ? Grid::constant(*real) : Grid::any(), set, Exactness::Rounded}
      .asGiven();
}

AbstractNumber AbstractNumber::constant(double value) { return inInterval(Interval::constant(value)); }

AbstractNumber AbstractNumber::inInterval(const Interval &interval) {
  return NumberParts{interval, {}, {}, Exactness::Exact}.result();
}

AbstractNumber AbstractNumber::integersIn(const Interval &interval) {
  return NumberParts{interval, Grid::integers(), {}, Exactness::Exact}.result();
}

std::optional<AbstractNumber> AbstractNumber::of(const Interval &interval, const Grid &grid, const FiniteSet &set,
                                                 Exactness exactness) {
  return NumberParts{interval, grid, set, exactness}.reduced();
}

std::optional<double> AbstractNumber::constantValue() const {
  return isConstant() ? std::optional(set().values().front()) : std::nullopt;
}

bool AbstractNumber::contains(double value) const {
  return interval().contains(value) && set().contains(value) && !(isExact() && grid().excludes(value));
}

bool AbstractNumber::containsExactly(const Rational &value) const {
  if (compare(value, interval().lo) < 0 || compare(value, interval().hi) > 0 || !grid().contains(value))
    return false;
  const Interval near = Interval::of(value);
  return !isExact() || set().isMany() || (near.isConstant() && set().contains(near.lo));
}

bool leq(const AbstractNumber &left, const AbstractNumber &right) {
  const bool isOnGrid = leq(left.grid(), right.grid()) || (left.isExact() && isOn(right.grid(), left.set()));
  // Members outside of the interval, as an arithmetic in which nothing is left may have, do not count.
  const auto computed = left.set().filter([&](double value) { return left.interval().contains(value); });
  const bool isInSet = !computed || leq(*computed, right.set());
  return isOnGrid && isInSet && leq(left.interval(), right.interval()) &&
         (left.isExact() || !right.isExact() || right.isInterval());
}

AbstractNumber join(const AbstractNumber &left, const AbstractNumber &right) {
  return NumberParts{join(left.interval(), right.interval()), join(left.grid(), right.grid()),
                     join(left.set(), right.set()), both(left, right)}
      .asGiven();
}

std::optional<AbstractNumber> meet(const AbstractNumber &left, const AbstractNumber &right) {
  const auto interval = meet(left.interval(), right.interval());
  if (!interval)
    return std::nullopt;
  if (left.isInterval())
    return within(right, *interval);
  if (right.isInterval())
    return within(left, *interval);
  if (left.isExact() == right.isExact())
    return meetOfAlike(left.parts(), right.parts(), *interval);
  return left.isExact() ? meetOfMixed(left.parts(), right.parts(), *interval)
                        : meetOfMixed(right.parts(), left.parts(), *interval);
}

AbstractNumber widen(const AbstractNumber &old, const AbstractNumber &next, std::span<const double> thresholds) {
  if (leq(next, old))
    return old;
  return NumberParts{widen(old.interval(), next.interval(), thresholds), widen(old.grid(), next.grid()),
                     widen(old.set(), next.set()), both(old, next)}
      .result();
}

AbstractNumber narrow(const AbstractNumber &old, const AbstractNumber &next) {
  return NumberParts{narrow(old.interval(), next.interval()), old.grid().isAny() ? next.grid() : old.grid(),
                     old.set().isMany() ? next.set() : old.set(), both(old, next)}
      .result();
}

std::optional<AbstractNumber> meetAtMost(const AbstractNumber &value, double bound) {
  return within(value, Interval::atMost(bound));
}

std::optional<AbstractNumber> meetAtLeast(const AbstractNumber &value, double bound) {
  return within(value, Interval::atLeast(bound));
}

std::optional<AbstractNumber> meetLess(const AbstractNumber &value, double bound) {
  const auto atMost = meetAtMost(value, bound);
  return atMost ? remove(*atMost, bound) : std::nullopt;
}

std::optional<AbstractNumber> meetGreater(const AbstractNumber &value, double bound) {
  const auto atLeast = meetAtLeast(value, bound);
  return atLeast ? remove(*atLeast, bound) : std::nullopt;
}

std::optional<AbstractNumber> remove(const AbstractNumber &value, double taken) {
  const Interval &interval = value.interval();
  if (!interval.contains(taken))
    return value;
  if (interval.isConstant())
    return std::nullopt;
  const auto set = value.set().filter([&](double member) { return member != taken; });
  const auto exact = Rational::fromDouble(taken);
  const bool noReal = exact && isRealConstant(value, *exact);
  NumberParts parts = value.parts();
  if (!set && (value.isExact() || noReal))
    return std::nullopt;
  if (set)
    parts.set = *set;
  if (!value.isExact() || !value.set().isMany())
    return parts.reduced();
  if (noReal)
    return std::nullopt;
  return exact && (interval.lo == taken || interval.hi == taken) ? withoutEnd(value, *exact, taken) : value;
}

Truth isEqual(const AbstractNumber &left, const AbstractNumber &right) { return compare(Relation::Equal, left, right); }

Truth isLess(const AbstractNumber &left, const AbstractNumber &right) { return compare(Relation::Less, left, right); }

Truth isAtMost(const AbstractNumber &left, const AbstractNumber &right) {
  return compare(Relation::AtMost, left, right);
}

} // namespace feedhold
