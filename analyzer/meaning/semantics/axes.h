// Axes: the axes of a machine by the letters of their words.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace feedhold {

/// In the order of the control's axis numbers (#5001 is X), as nearly all machines have them.
enum class Axis : std::uint8_t { X, Y, Z, A, B, C, U, V, W };
inline constexpr std::size_t kAxisCount = 9;
inline constexpr std::array<char, kAxisCount> kAxisLetters = {'X', 'Y', 'Z', 'A', 'B', 'C', 'U', 'V', 'W'};
inline constexpr std::array kAllAxes = {Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::B,
                                        Axis::C, Axis::U, Axis::V, Axis::W};

constexpr std::size_t indexOf(Axis axis) { return static_cast<std::size_t>(axis); }
constexpr char letterOf(Axis axis) { return kAxisLetters[indexOf(axis)]; }
constexpr bool isLinear(Axis axis) { return axis != Axis::A && axis != Axis::B && axis != Axis::C; }
constexpr std::optional<Axis> axisOf(char letter) {
  for (const Axis axis : kAllAxes)
    if (letterOf(axis) == letter)
      return axis;
  return std::nullopt;
}

/// Some of the axes, by indexOf.
using AxisSet = std::bitset<kAxisCount>;

/// The axes of a working plane: arcs turn from `first` to `second`, holes are drilled along `normal`.
struct Plane {
  Axis first;
  Axis second;
  Axis normal;
  // The letters of the distances to the centre of an arc.
  char firstCentre;
  char secondCentre;
};
inline constexpr Plane kPlaneXY{Axis::X, Axis::Y, Axis::Z, 'I', 'J'};
inline constexpr Plane kPlaneZX{Axis::Z, Axis::X, Axis::Y, 'K', 'I'};
inline constexpr Plane kPlaneYZ{Axis::Y, Axis::Z, Axis::X, 'J', 'K'};

} // namespace feedhold
