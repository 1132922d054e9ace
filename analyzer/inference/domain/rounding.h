// Bounds of one operation on doubles: the largest double not above, and the smallest not below, the exact result.
#pragma once

#include <cmath>
#include <limits>
#include <utility>

namespace feedhold::rounding {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline double below(double value) { return std::nextafter(value, -kInfinity); }
inline double above(double value) { return std::nextafter(value, kInfinity); }

/// Equal where the operation was exact.
struct Bounds {
  double down;
  double up;
};

/// From the rounded result and the sign of (exact - rounded).
inline Bounds fromError(double rounded, double error) {
  return {error < 0 ? below(rounded) : rounded, error > 0 ? above(rounded) : rounded};
}

inline Bounds around(double rounded) { return {below(rounded), above(rounded)}; }

/// A finite result that was too large for a double.
inline Bounds overflow(double rounded) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  return rounded > 0 ? Bounds{kLargest, kInfinity} : Bounds{-kInfinity, -kLargest};
}

inline Bounds add(double left, double right) {
  const double sum = left + right;
  if (std::isinf(left) || std::isinf(right))
    return {sum, sum};
  if (std::isinf(sum))
    return overflow(sum);
  // TwoSum (Knuth, The Art of Computer Programming 2, 4.2.2): the error of a sum is a double.
  const double rightPart = sum - left;
  const double leftPart = sum - rightPart;
  const double error = (left - leftPart) + (right - rightPart);
  return std::isfinite(error) ? fromError(sum, error) : around(sum);
}

/// Below this magnitude the error of a product or a quotient may itself be rounded away.
inline constexpr double kTiny = 0x1p-960;

inline Bounds multiply(double left, double right) {
  if (left == 0 || right == 0)
    return {0, 0}; // also 0 * infinity: a bound that is not there stands for finite numbers only
  const double product = left * right;
  if (std::isinf(left) || std::isinf(right))
    return {product, product};
  if (std::isinf(product))
    return overflow(product);
  if (std::abs(product) < kTiny)
    return around(product);
  return fromError(product, std::fma(left, right, -product));
}

/// The divisor is not 0.
inline Bounds divide(double left, double right) {
  if (left == 0)
    return {0, 0};
  if (std::isinf(right)) // infinity / infinity too: the limit that a corner needs is the one with finite left
    return {0, 0};
  const double quotient = left / right;
  if (std::isinf(left))
    return {quotient, quotient};
  if (std::isinf(quotient))
    return overflow(quotient);
  if (std::abs(quotient) < kTiny || std::abs(left) < kTiny)
    return around(quotient);
  const double rest = std::fma(-quotient, right, left); // left - quotient * right, exactly
  return fromError(quotient, right > 0 ? rest : -rest);
}

inline Bounds squareRoot(double value) {
  const double root = std::sqrt(value);
  if (value == 0 || std::isinf(value))
    return {root, root};
  if (value < kTiny)
    return around(root);
  return fromError(root, std::fma(-root, root, value));
}

} // namespace feedhold::rounding
