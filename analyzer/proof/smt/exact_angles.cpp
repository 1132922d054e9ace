#include "proof/smt/exact_angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace feedhold::smt {
namespace {

/// In 0 <= angle < 360.
Number reduced(const Number &degrees) { return degrees - floor(degrees / 360) * 360; }

/// The C library's sine is right to about 1e-16 on a reduced angle; converting the angle adds as much.  A thousandth of
/// a billionth is far outside of both.
constexpr double kMargin = 1e-12;

} // namespace

std::optional<Number> exactSine(const Number &degrees) {
  const Number angle = reduced(degrees);
  if (angle.isZero() || angle == Number(180))
    return Number(0);
  if (angle == Number(90) || angle == Number(270))
    return Number(angle == Number(90) ? 1 : -1);
  if (angle == Number(30) || angle == Number(150))
    return Number(1) / 2;
  if (angle == Number(210) || angle == Number(330))
    return Number(-1) / 2;
  return std::nullopt;
}

std::optional<Number> exactTangent(const Number &degrees) {
  const Number angle = degrees - floor(degrees / 180) * 180;
  if (angle.isZero())
    return Number(0);
  if (angle == Number(45) || angle == Number(135))
    return Number(angle == Number(45) ? 1 : -1);
  return std::nullopt;
}

std::optional<Number> exactArcSine(const Number &sine) {
  if (sine.isZero())
    return Number(0);
  if (abs(sine) == Number(1))
    return sine * 90;
  if (abs(sine) == Number(1) / 2)
    return sine * 60;
  return std::nullopt;
}

Enclosure encloseSine(const Number &degrees) {
  const double sine = std::sin(reduced(degrees).toDouble() * std::numbers::pi / 180);
  return {std::max(Number::fromDouble(sine - kMargin), Number(-1)),
          std::min(Number::fromDouble(sine + kMargin), Number(1))};
}

} // namespace feedhold::smt
