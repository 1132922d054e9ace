// TipDirection: where the programmed point of a lathe tool lies beside the centre of its nose.
#pragma once

#include "base/support/check.h"

#include <array>
#include <cstdint>

namespace feedhold {

inline constexpr std::uint8_t kTipDirections = 10;

/// In radii along X and Z: -1, 0 or 1.
struct TipDirection {
  int x = 0;
  int z = 0;
  friend bool operator==(const TipDirection &, const TipDirection &) = default;
};

/// Of the number that controls give it (X up, Z to the right; docs/geometry.md); 0 and 9: the centre itself.
inline TipDirection tipDirection(std::uint8_t number) {
  constexpr std::array<TipDirection, kTipDirections> kDirections = {
      {{0, 0}, {1, 1}, {1, -1}, {-1, -1}, {-1, 1}, {0, 1}, {1, 0}, {0, -1}, {-1, 0}, {0, 0}}};
  FEEDHOLD_CHECK(number < kDirections.size(), "readers let only these numbers pass");
  return kDirections[number];
}

} // namespace feedhold
