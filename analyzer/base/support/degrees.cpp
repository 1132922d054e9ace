// Angles in degrees by way of libm in radians.
#include "base/support/degrees.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace feedhold {

namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr double kDegrees = 180 / std::numbers::pi;

/// Sine of rest + 90 * quarters, where rest is in [-45, 45].
double sineOf(double rest, int quarters) {
  switch (quarters & 3) {
  case 0: return std::sin(rest * kRadians);
  case 1: return std::cos(rest * kRadians);
  case 2: return 0 - std::sin(rest * kRadians);
  default: return -std::cos(rest * kRadians);
  }
}

} // namespace

double sinDegrees(double angle) {
  int quarters = 0;
  const double rest = std::remquo(angle, 90, &quarters);
  return sineOf(rest, quarters) + 0.0; // no negative zero
}

double cosDegrees(double angle) {
  int quarters = 0;
  const double rest = std::remquo(angle, 90, &quarters);
  return sineOf(rest, quarters + 1) + 0.0;
}

double tanDegrees(double angle) {
  const double cosine = cosDegrees(angle);
  const double sine = sinDegrees(angle);
  if (cosine == 0)
    return std::copysign(std::numeric_limits<double>::infinity(), sine);
  // Both come from the same reduced angle: at odd multiples of 45 they may differ in the last place.
  if (std::remainder(angle, 90) == 45 || std::remainder(angle, 90) == -45)
    return std::signbit(sine) == std::signbit(cosine) ? 1 : -1;
  return sine / cosine + 0.0;
}

double asinDegrees(double sine) { return std::asin(sine) * kDegrees; }
double acosDegrees(double cosine) { return std::acos(cosine) * kDegrees; }
double atanDegrees(double tangent) { return std::atan(tangent) * kDegrees; }

double atan2Degrees(double y, double x) {
  // Adding 0 turns -0 into 0, so that the negative x axis is at 180 and never at -180.
  return std::atan2(y + 0.0, x + 0.0) * kDegrees;
}

} // namespace feedhold
