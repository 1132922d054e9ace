// Numbers of a control whose mantissas may have 32 bits: what it keeps of a result.
#pragma once

#include "base/support/mantissa32.h"
#include "inference/domain/number.h"

namespace feedhold {

/// Each member has 32 bits of mantissa in every arithmetic; whole numbers up to 2^31 do.
bool fitsMantissa32(const AbstractNumber &number);

/// A result as doubles, exact numbers and mantissas of 32 bits may keep it: where it fits these, it is exact.  Where
/// nothing but its nearest number is taken (no error), a decimal fraction stays known.
AbstractNumber heldInMantissa32(const AbstractNumber &result, const mantissa32::Error &error);

/// Likewise of a sum of members of the two intervals, which does not fit.
AbstractNumber heldSumInMantissa32(const AbstractNumber &sum, const Interval &left, const Interval &right);

/// Every model has the same nearest number for both: the decimal fraction that they are.
bool isSameDecimal(const AbstractNumber &left, const AbstractNumber &right);
/// What is true of a held number in mantissas of 32 bits, too: grid and set of rounded ones speak of the other two.
AbstractNumber inEveryModel(const AbstractNumber &number);

/// The bounds by so much further apart, as a share of the size of each.
Interval loosenedBy(const Interval &interval, double share);

} // namespace feedhold
