// Grids: congruences over fractions.
#include "inference/domain/grid.h"

#include <cmath>

namespace feedhold {

namespace {

/// offset + step * n for the sum of some steps; any number when one of them did not fit.
Grid gridOf(const std::optional<Rational> &step, const std::optional<Rational> &offset) {
  return step && offset ? Grid::of(*step, *offset) : Grid::any();
}

std::optional<Rational> gcdOf(const std::optional<Rational> &left, const std::optional<Rational> &right) {
  return left && right ? gcd(*left, *right) : std::nullopt;
}

std::optional<Rational> scaled(const std::optional<Rational> &value, std::int64_t times) {
  return value ? multiply(*value, Rational(times)) : std::nullopt;
}

/// The inverse of value modulo modulus, for coprime values (extended Euclid).
std::int64_t inverseModulo(std::int64_t value, std::int64_t modulus) {
  std::int64_t rest = value % modulus, lastRest = modulus;
  std::int64_t factor = 1, lastFactor = 0;
  while (rest != 0) {
    const std::int64_t quotient = lastRest / rest;
    const std::int64_t nextRest = lastRest - quotient * rest;
    lastRest = rest;
    rest = nextRest;
    const std::int64_t nextFactor = lastFactor - quotient * factor;
    lastFactor = factor;
    factor = nextFactor;
  }
  return lastFactor < 0 ? lastFactor + modulus : lastFactor;
}

/// Solves offset + step * n = a number of `other`, both with steps (Chinese remainders, in units of the common step).
std::optional<Grid> meetOfSteps(const Grid &left, const Grid &right) {
  const auto common = gcd(left.step(), right.step());
  const auto distance = subtract(right.offset(), left.offset());
  if (!common || !distance)
    return left;
  const auto leftUnits = divide(left.step(), *common);
  const auto rightUnits = divide(right.step(), *common);
  const auto units = divide(*distance, *common);
  if (!leftUnits || !rightUnits || !units)
    return left;
  if (!units->isInteger())
    return std::nullopt;
  const std::int64_t modulus = rightUnits->numerator();
  // leftUnits * n = units (mod modulus), and leftUnits is coprime to the modulus.
  const auto steps =
      multiply(Rational(units->numerator() % modulus), Rational(inverseModulo(leftUnits->numerator(), modulus)));
  if (!steps)
    return left;
  const auto shift = scaled(left.step(), steps->numerator() % modulus);
  const auto offset = shift ? add(left.offset(), *shift) : std::nullopt;
  const auto step = scaled(left.step(), modulus);
  const Grid both = gridOf(step, offset);
  return both.isAny() ? left : both;
}

} // namespace

Grid Grid::of(const Rational &step, const Rational &offset) {
  if (step.isZero())
    return constant(offset);
  const auto size = step.isNegative() ? feedhold::negate(step) : step;
  const auto steps = size ? divide(offset, *size) : std::nullopt;
  if (!steps)
    return any();
  const auto whole = scaled(size, feedhold::floor(*steps));
  const auto rest = whole ? feedhold::subtract(offset, *whole) : std::nullopt;
  return rest ? Grid(*rest, *size) : any();
}

bool Grid::excludes(double value) const {
  if (isAny_)
    return false;
  if (const auto exact = Rational::fromDouble(value))
    return !contains(*exact);
  // A double below 1 that is no fraction of 64 bits has a power of two in its denominator that no member can have.
  return std::abs(value) < 1;
}

bool Grid::contains(double value, double tolerance) const {
  if (isAny_)
    return true;
  const double distance = value - offset_.toDouble();
  return std::abs(step_.isZero() ? distance : std::remainder(distance, step_.toDouble())) <= tolerance;
}

std::optional<Rational> Grid::atOrBelow(const Rational &bound) const {
  if (isAny_)
    return std::nullopt;
  if (step_.isZero())
    return offset_ <= bound ? std::optional(offset_) : std::nullopt;
  const auto distance = feedhold::subtract(bound, offset_);
  const auto steps = distance ? divide(*distance, step_) : std::nullopt;
  const auto shift = steps ? scaled(step_, feedhold::floor(*steps)) : std::nullopt;
  return shift ? feedhold::add(offset_, *shift) : std::nullopt;
}

std::optional<Rational> Grid::atOrAbove(const Rational &bound) const {
  const auto mirrored = feedhold::negate(bound);
  const auto below = mirrored ? feedhold::negate(*this).atOrBelow(*mirrored) : std::nullopt;
  return below ? feedhold::negate(*below) : std::nullopt;
}

bool leq(const Grid &left, const Grid &right) {
  if (right.isAny())
    return true;
  return !left.isAny() && differByMultiple(left.step(), Rational(), right.step()) && right.contains(left.offset());
}

Grid join(const Grid &left, const Grid &right) {
  if (left.isAny() || right.isAny())
    return Grid::any();
  if (left == right)
    return left;
  const auto distance = subtract(left.offset(), right.offset());
  const auto step = gcdOf(gcd(left.step(), right.step()), distance);
  const Grid grid = gridOf(step, left.offset());
  return grid.isAny() ? gridOf(step, right.offset()) : grid;
}

std::optional<Grid> meet(const Grid &left, const Grid &right) {
  if (left.isAny())
    return right;
  if (right.isAny())
    return left;
  if (left.isConstant())
    return right.contains(left.offset()) ? std::optional(left) : std::nullopt;
  if (right.isConstant())
    return left.contains(right.offset()) ? std::optional(right) : std::nullopt;
  return meetOfSteps(left, right);
}

Grid widen(const Grid &old, const Grid &next) {
  const Grid both = join(old, next);
  if (both == old || both.isAny() || old.isConstant() || both == Grid::integers())
    return both;
  return both.isWhole() ? Grid::integers() : Grid::any();
}

Grid add(const Grid &left, const Grid &right) {
  if (left.isAny() || right.isAny())
    return Grid::any();
  return gridOf(gcd(left.step(), right.step()), add(left.offset(), right.offset()));
}

Grid subtract(const Grid &left, const Grid &right) { return add(left, negate(right)); }

Grid multiply(const Grid &left, const Grid &right) {
  const auto isZero = [](const Grid &grid) { return grid.isConstant() && grid.offset().isZero(); };
  if (isZero(left) || isZero(right))
    return Grid::constant(Rational());
  if (left.isAny() || right.isAny())
    return Grid::any();
  // (o + s m)(p + t n) = o p + o t n + p s m + s t m n
  const auto crossed = gcdOf(multiply(left.offset(), right.step()), multiply(right.offset(), left.step()));
  return gridOf(gcdOf(crossed, multiply(left.step(), right.step())), multiply(left.offset(), right.offset()));
}

Grid negate(const Grid &value) { return value.isAny() ? value : gridOf(value.step(), negate(value.offset())); }

Grid divideBy(const Grid &value, const Rational &divisor) {
  if (value.isAny())
    return value;
  return gridOf(divide(value.step(), divisor), divide(value.offset(), divisor));
}

Grid remainder(const Grid &left, const Grid &right) {
  if (left.isAny() || right.isAny())
    return Grid::any();
  return gridOf(gcdOf(gcd(left.step(), right.step()), right.offset()), left.offset());
}

} // namespace feedhold
