// Intervals: roots, angles, logarithms and powers.
#include "inference/domain/interval.h"

#include "base/support/degrees.h"
#include "inference/domain/rounding.h"

#include <algorithm>
#include <cmath>

namespace feedhold {

namespace {

using rounding::kInfinity;

/// What libm may be off by: 4 units in the last place (glibc promises 1 or 2 for the functions used here; controls
/// and other libraries get the rest), and an absolute part for results near 0.
constexpr double kRelative = 4 * std::numeric_limits<double>::epsilon();
constexpr double kAbsolute = 1e-15;

double marginAt(double value) { return std::isinf(value) ? 0 : std::abs(value) * kRelative + kAbsolute; }
Interval around(double value, double margin) { return {value - margin, value + margin}; }
Interval around(double value) { return around(value, marginAt(value)); }

/// Of a function that grows with its argument.
template <typename Function> Interval growing(const Interval &value, Function &&at) {
  return {at(value.lo).lo + 0.0, at(value.hi).hi + 0.0};
}

Interval clamp(const Interval &value, double least, double most) {
  return {std::clamp(value.lo, least, most), std::clamp(value.hi, least, most)};
}

/// The error that an angle has once it is in radians, for a program that does not first reduce it.
double errorOfAngle(double angle) { return kAbsolute + std::abs(angle) * 5e-18; }

bool isMultipleOf90(double angle) { return std::fmod(angle, 90) == 0; }

Interval sineAt(double angle) {
  const double value = sinDegrees(angle);
  if (isMultipleOf90(angle))
    return Interval::constant(value);
  return clamp(around(value, std::abs(value) * kRelative + errorOfAngle(angle)), -1, 1);
}

Interval cosineAt(double angle) {
  const double value = cosDegrees(angle);
  if (isMultipleOf90(angle))
    return Interval::constant(value);
  return clamp(around(value, std::abs(value) * kRelative + errorOfAngle(angle)), -1, 1);
}

/// Beyond this, neighbouring doubles are too far apart for an angle to mean much.
constexpr double kLargestAngle = 1e12;

/// An angle phase + 360 * n, for a whole n, lies in the interval.
bool containsPhase(const Interval &angle, double phase) {
  const double turns = std::ceil((angle.lo - phase) / 360);
  // One turn each way makes up for the rounding of the quotient; the products are exact below kLargestAngle.
  for (const double n : {turns - 1, turns, turns + 1}) {
    if (angle.contains(phase + 360 * n))
      return true;
  }
  return false;
}

/// A function of period 360 between -1 and 1 that is monotone between `top` and `bottom`.
template <typename Function> Interval wave(const Interval &angle, double top, double bottom, Function &&at) {
  if (!angle.isFinite() || angle.largest() > kLargestAngle || angle.width() >= 360)
    return {-1, 1};
  Interval result = join(at(angle.lo), at(angle.hi));
  if (containsPhase(angle, top))
    result.hi = 1;
  if (containsPhase(angle, bottom))
    result.lo = -1;
  return result;
}

Interval tangentAt(double angle) {
  const double value = tanDegrees(angle);
  if (std::fmod(angle, 180) == 0)
    return Interval::constant(0);
  // The derivative is 1 + tan^2: near 90 the error of the angle counts most.
  const double margin = std::abs(value) * kRelative + (1 + value * value) * errorOfAngle(angle);
  return margin < std::abs(value) / 2 || std::abs(value) < 1 ? around(value, margin) : Interval::all();
}

Interval arcSineAt(double sine) {
  return sine == 0 || std::abs(sine) == 1 ? Interval::constant(sine * 90) : clamp(around(asinDegrees(sine)), -90, 90);
}

Interval arcCosineAt(double cosine) {
  return cosine == 0 || std::abs(cosine) == 1 ? Interval::constant(90 - cosine * 90)
                                              : clamp(around(acosDegrees(cosine)), 0, 180);
}

Interval atan2At(double y, double x) {
  const double value = atan2Degrees(y, x);
  if (y == 0 || x == 0)
    return Interval::constant(std::round(value));
  return clamp(around(value), -180, 180);
}

Interval logarithmAt(double value) {
  if (value == 0)
    return Interval::constant(-kInfinity);
  return value == 1 ? Interval::constant(0) : around(std::log(value));
}

Interval exponentialAt(double value) {
  if (value == 0)
    return Interval::constant(1);
  const double result = std::exp(value);
  if (std::isinf(result) && std::isfinite(value))
    return {std::numeric_limits<double>::max(), kInfinity};
  const Interval wide = around(result);
  return {std::max(0.0, wide.lo), wide.hi};
}

/// A power of a base > 0.
Interval powerAt(double base, double exponent) {
  const double result = std::pow(base, exponent);
  if (base == 1 || exponent == 0)
    return Interval::constant(1);
  const bool isInfinite = std::isinf(base) || std::isinf(exponent);
  if (std::isinf(result) && !isInfinite && base != 0)
    return {std::numeric_limits<double>::max(), kInfinity};
  const Interval wide = around(result);
  return {std::max(0.0, wide.lo), wide.hi};
}

/// Over bases >= 0: a power is monotone in each of its parts, so that its extremes lie in the corners.
Interval powerOfPositive(const Interval &base, const Interval &exponent) {
  Interval result = powerAt(base.lo, exponent.lo);
  for (const Interval &corner :
       {powerAt(base.lo, exponent.hi), powerAt(base.hi, exponent.lo), powerAt(base.hi, exponent.hi)})
    result = join(result, corner);
  // The limits 0^0 and infinity^0 are no corners: between them lies every power.
  const bool endsAtLimit = (base.lo == 0 || base.hi == kInfinity) && exponent.contains(0.0);
  if (endsAtLimit && !exponent.isConstant())
    return Interval::atLeast(0);
  return result;
}

/// base^count where multiplication is exact all the way; absent otherwise.
std::optional<double> exactPower(double base, int count) {
  double result = 1;
  for (int i = 0; i < count; ++i) {
    const rounding::Bounds next = rounding::multiply(result, base);
    if (next.down != next.up || std::isinf(next.up))
      return std::nullopt;
    result = next.up;
  }
  return result;
}

std::optional<Interval> wholePower(const Interval &base, double exponent) {
  constexpr double kMostMultiplications = 64;
  if (base.isConstant() && exponent >= 0 && exponent <= kMostMultiplications) {
    if (const auto exact = exactPower(base.lo, static_cast<int>(exponent)))
      return Interval::constant(*exact);
  }
  if (exponent < 0) {
    const auto inverse = wholePower(base, -exponent);
    const auto quotient = inverse ? divide(Interval::constant(1), *inverse) : std::nullopt;
    if (!quotient || quotient->isConstant())
      return quotient;
    return Interval{around(quotient->lo).lo, around(quotient->hi).hi};
  }
  const Interval power = Interval::constant(exponent);
  if (base.lo >= 0)
    return powerOfPositive(base, power);
  if (std::fmod(exponent, 2) == 0)
    return powerOfPositive(absolute(base), power);
  const Interval negative = negate(powerOfPositive(negate(Interval{base.lo, std::min(base.hi, 0.0)}), power));
  return base.hi <= 0 ? negative : join(negative, powerOfPositive({0, base.hi}, power));
}

} // namespace

std::optional<Interval> sqrt(const Interval &value) {
  if (value.hi < 0)
    return std::nullopt;
  return Interval{rounding::squareRoot(std::max(0.0, value.lo)).down, rounding::squareRoot(value.hi).up};
}

Interval sin(const Interval &angle) { return wave(angle, 90, 270, sineAt); }

Interval cos(const Interval &angle) { return wave(angle, 0, 180, cosineAt); }

Interval tan(const Interval &angle) {
  const bool isWide = !angle.isFinite() || angle.largest() > kLargestAngle || angle.width() >= 180;
  if (isWide || containsPhase(angle, 90) || containsPhase(angle, 270))
    return Interval::all();
  return growing(angle, tangentAt);
}

std::optional<Interval> asin(const Interval &sine) {
  const auto part = meet(sine, {-1, 1});
  if (!part)
    return std::nullopt;
  return growing(*part, arcSineAt);
}

std::optional<Interval> acos(const Interval &cosine) {
  const auto part = meet(cosine, {-1, 1});
  if (!part)
    return std::nullopt;
  return Interval{arcCosineAt(part->hi).lo, arcCosineAt(part->lo).hi};
}

Interval atanDegrees(const Interval &tangent) {
  return growing(tangent, [](double value) {
    const double angle = atanDegrees(value);
    return value == 0 ? Interval::constant(0) : clamp(around(angle), -90, 90);
  });
}

Interval atan2Degrees(const Interval &y, const Interval &x) {
  // Across the negative x axis the angle jumps from -180 to 180.
  if (y.lo < 0 && y.hi >= 0 && x.lo < 0)
    return {-180, 180};
  if (y.contains(0.0) && x.contains(0.0)) {
    if (x.lo >= 0)
      return {y.lo < 0 ? -90.0 : 0.0, y.hi > 0 ? 90.0 : 0.0};
    return {0, 180}; // y >= 0, or the jump had been seen
  }
  // Seen from outside of a box, the extreme angles are those of its corners.
  Interval result = atan2At(y.lo, x.lo);
  for (const Interval &corner : {atan2At(y.lo, x.hi), atan2At(y.hi, x.lo), atan2At(y.hi, x.hi)})
    result = join(result, corner);
  return result;
}

std::optional<Interval> ln(const Interval &value) {
  if (value.hi <= 0)
    return std::nullopt;
  return growing(Interval{std::max(0.0, value.lo), value.hi}, logarithmAt);
}

Interval exp(const Interval &value) { return growing(value, exponentialAt); }

std::optional<Interval> pow(const Interval &base, const Interval &exponent) {
  constexpr double kLargestWhole = 1e6;
  if (exponent.isConstant() && std::trunc(exponent.lo) == exponent.lo && std::abs(exponent.lo) <= kLargestWhole)
    return wholePower(base, exponent.lo);
  const bool mayHaveWholeExponent = std::floor(exponent.hi) >= std::ceil(exponent.lo);
  if (base.lo < 0 && mayHaveWholeExponent)
    return Interval::all();
  if (base.hi < 0)
    return std::nullopt;
  const Interval part{std::max(0.0, base.lo), base.hi};
  if (part.hi == 0) {
    // 0 to a positive power.
    if (exponent.hi < 0)
      return std::nullopt;
    return Interval{0, exponent.contains(0.0) ? 1.0 : 0.0};
  }
  return powerOfPositive(part, exponent);
}

} // namespace feedhold
