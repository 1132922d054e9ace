// NumberParts: what is known of a number, part by part: its bounds, its grid, and its few possible values.
#pragma once

#include "inference/domain/finite_set.h"
#include "inference/domain/grid.h"
#include "inference/domain/interval.h"

#include <cstdint>
#include <optional>

namespace feedhold {

class AbstractNumber;

/// A control may compute with exact real numbers or with doubles: how it does is not published.  Both arithmetics
/// are kept: the interval holds the values of both.  Exact: grid and set do so too.  Rounded: the two
/// may differ (as they do from 0.1 on); then the grid speaks of the real value alone, and the set of the computed one.
enum class Exactness : std::uint8_t { Exact, Rounded };

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

  friend bool operator==(const NumberParts &, const NumberParts &) = default;
};

/// Doubles hold every member of the grid inside the interval.
bool fitsDoubles(const Grid &grid, const Interval &interval);

} // namespace feedhold
