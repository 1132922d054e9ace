// Numbers with a mantissa of 32 bits, as the FANUC Series 16i, 18i and 21i compute with (docs/arithmetic.md).
#pragma once

#include <cmath>

namespace feedhold::mantissa32 {

// Beyond these magnitudes the control stops with alarm 111, below the smallest one too: nothing is flushed to 0.
inline constexpr double kSmallest = 1e-29;
inline constexpr double kLargest = 1e47;

namespace detail {
/// toWhole: which of the two whole numbers beside a mantissa that is scaled to its last bit.
template <typename ToWhole> double rounded(double value, ToWhole toWhole) {
  constexpr int kBits = 32;
  if (value == 0 || !std::isfinite(value))
    return value;
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  return std::ldexp(toWhole(std::ldexp(mantissa, kBits)), exponent - kBits);
}
} // namespace detail

/// The nearest number; of two that are equally near, the one whose last bit is 0.
inline double nearest(double value) {
  return detail::rounded(value, [](double mantissa) { return std::nearbyint(mantissa); });
}
/// The number itself where it has 32 bits.
inline double atOrBelow(double value) {
  return detail::rounded(value, [](double mantissa) { return std::floor(mantissa); });
}
inline double atOrAbove(double value) {
  return detail::rounded(value, [](double mantissa) { return std::ceil(mantissa); });
}

/// How far a result may be from the exact one, at most; one that has 32 bits is exact.
struct Error {
  double relative = 0; // of the result
  double absolute = 0;
};
// By the table of the 16i operator's manual.  Of the larger operand:
inline constexpr double kErrorOfSum = 5.32e-10;
inline constexpr Error kErrorOfProduct{4.66e-10, 0};
inline constexpr Error kErrorOfQuotient{1.88e-9, 0};
inline constexpr Error kErrorOfRoot{3.73e-9, 0};
inline constexpr Error kErrorOfSine{0, 1e-8};
inline constexpr Error kErrorOfAngle{0, 3.6e-6}; // in degrees
/// LN, EXP, POW: the table has no row for them; the largest of its other errors.
inline constexpr Error kErrorOfOthers{1e-8, 1e-8};

inline bool isInRange(double value) {
  const double size = std::fabs(value);
  return size == 0 || (size >= kSmallest && size <= kLargest);
}

} // namespace feedhold::mantissa32
