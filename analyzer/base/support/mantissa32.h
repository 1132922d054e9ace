// Numbers with a mantissa of 32 bits, as the FANUC Series 16i, 18i and 21i compute with (docs/arithmetic.md).
#pragma once

#include <cmath>

namespace feedhold::mantissa32 {

// Beyond these magnitudes the control stops with alarm 111, below the smallest one too: nothing is flushed to 0.
inline constexpr double kSmallest = 1e-29;
inline constexpr double kLargest = 1e47;

/// The nearest number; of two that are equally near, the one whose last bit is 0.
inline double nearest(double value) {
  constexpr int kBits = 32;
  if (value == 0 || !std::isfinite(value))
    return value;
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  return std::ldexp(std::nearbyint(std::ldexp(mantissa, kBits)), exponent - kBits);
}

inline bool isInRange(double value) {
  const double size = std::fabs(value);
  return size == 0 || (size >= kSmallest && size <= kLargest);
}

} // namespace feedhold::mantissa32
