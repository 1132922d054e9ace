// NumberParts: the parts of an abstract number while they are put together.
#pragma once

#include "inference/domain/number.h"

namespace feedhold {

struct NumberParts {
  Interval interval;
  Grid grid;
  FiniteSet set;
  Exactness exactness = Exactness::Exact;

  /// The number as it is: the parts agree with each other.
  AbstractNumber asGiven() const;
  /// Each part drawn tighter by the others; absent when nothing is left.
  std::optional<AbstractNumber> reduced() const;
  /// Of parts that have a common member because their operands had.
  AbstractNumber result() const;
};

/// Exact when both are.
constexpr Exactness both(const AbstractNumber &left, const AbstractNumber &right) {
  return left.isExact() && right.isExact() ? Exactness::Exact : Exactness::Rounded;
}

/// Doubles hold every member of the grid inside the interval.
bool fitsDoubles(const Grid &grid, const Interval &interval);

} // namespace feedhold
