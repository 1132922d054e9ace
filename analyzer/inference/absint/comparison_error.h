// Comparisons of a control whose mantissas may have 32 bits: they have the error of a subtraction.
#pragma once

#include "inference/domain/mantissa_number.h"

namespace feedhold {

/// A difference is off by a share of the larger operand; where the smaller one is 0, its sign is right.  So a share of
/// either operand covers it, if it is a little larger.
inline constexpr double kErrorOfComparison = 1.01 * mantissa32::kErrorOfSum;

/// What may stand in for a number that `left` is compared with; differences of numbers that fit are exact.
inline AbstractNumber loosenedFor(const AbstractNumber &left, const AbstractNumber &right) {
  if ((fitsMantissa32(left) && fitsMantissa32(right)) || isSameDecimal(left, right))
    return right;
  const AbstractNumber known = inEveryModel(right);
  if (!known.isInterval() && !inEveryModel(left).isInterval())
    return right; // coordinates, which are counted in increments
  const Interval loosened = loosenedBy(known.interval(), kErrorOfComparison);
  return loosened == known.interval() ? known : AbstractNumber::inInterval(loosened);
}

} // namespace feedhold
