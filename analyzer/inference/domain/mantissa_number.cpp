#include "inference/domain/mantissa_number.h"

#include <algorithm>
#include <cmath>

namespace feedhold {

namespace {

constexpr double kExactIntegers = 2147483648.0; // 2^31

/// All members are whole multiples of 1 / result, in every arithmetic; absent where none is known.
std::optional<std::int64_t> finestOf(const AbstractNumber &number) {
  const Grid &grid = number.grid();
  if (!number.isExact() || grid.isAny() || !grid.offset().isDyadic() || !grid.step().isDyadic())
    return std::nullopt;
  return std::max(grid.offset().denominator(), grid.step().denominator());
}

bool isAtMost(const Interval &interval, std::int64_t finest) {
  return interval.isFinite() && interval.largest() <= kExactIntegers / static_cast<double>(finest);
}

/// One double further out: the errors themselves are computed in doubles.
Interval withErrors(const Interval &interval, double low, double high) {
  return {mantissa32::atOrBelow(low == 0 ? interval.lo : std::nextafter(interval.lo - low, -INFINITY)),
          mantissa32::atOrAbove(high == 0 ? interval.hi : std::nextafter(interval.hi + high, INFINITY))};
}
double errorAt(double bound, const mantissa32::Error &error) {
  return std::isfinite(bound) ? error.relative * std::fabs(bound) + error.absolute : 0;
}
double errorOfSum(double left, double right) {
  const double larger = std::max(std::fabs(left), std::fabs(right));
  return std::isfinite(larger) ? mantissa32::kErrorOfSum * larger : 0; // else there is no such end
}

/// Multiples of a power of two stay so, and other numbers keep nothing but their bounds.
AbstractNumber rounded(const AbstractNumber &result, const Interval &held, std::optional<std::int64_t> finest) {
  const auto step = finest ? Rational::make(1, *finest) : std::nullopt;
  const NumberParts parts{held, step ? Grid::of(*step, Rational()) : Grid::any(), {}, Exactness::Exact};
  return parts == result.parts() ? result : parts.result();
}

/// A decimal fraction that each model has as its nearest number.
bool isDecimal(const AbstractNumber &number) {
  return !number.isExact() && number.grid().isConstant() &&
         number.set() == FiniteSet::constant(number.grid().offset().toDouble());
}

} // namespace

bool fitsMantissa32(const AbstractNumber &number) {
  const auto finest = finestOf(number);
  return finest && isAtMost(number.interval(), *finest);
}

AbstractNumber heldInMantissa32(const AbstractNumber &result, const mantissa32::Error &error) {
  const auto finest = finestOf(result);
  if (finest && isAtMost(result.interval(), *finest))
    return result;
  const Interval &bounds = result.interval();
  const Interval held = withErrors(bounds, errorAt(bounds.lo, error), errorAt(bounds.hi, error));
  if (error.relative != 0 || error.absolute != 0 || !isDecimal(result))
    return rounded(result, held, finest);
  return held == bounds ? result : NumberParts{held, result.grid(), result.set(), Exactness::Rounded}.asGiven();
}

bool isSameDecimal(const AbstractNumber &left, const AbstractNumber &right) {
  return isDecimal(left) && isDecimal(right) && left.grid() == right.grid();
}

AbstractNumber inEveryModel(const AbstractNumber &number) {
  const Interval &bounds = number.interval();
  const bool isHeld = mantissa32::nearest(bounds.lo) == bounds.lo && mantissa32::nearest(bounds.hi) == bounds.hi;
  return number.isExact() || !isHeld ? number : AbstractNumber::inInterval(bounds);
}

AbstractNumber heldSumInMantissa32(const AbstractNumber &sum, const Interval &left, const Interval &right) {
  // The error grows more slowly than the operands: the least sum is that of the least operands.
  const Interval bounds = add(left, right);
  return rounded(sum, withErrors(bounds, errorOfSum(left.lo, right.lo), errorOfSum(left.hi, right.hi)), finestOf(sum));
}

Interval loosenedBy(const Interval &interval, double share) {
  const auto by = [&](double bound) { return std::isfinite(bound) ? share * std::fabs(bound) : 0.0; };
  return {interval.lo - by(interval.lo), interval.hi + by(interval.hi)};
}

} // namespace feedhold
