// GougeSearch: where on a move, or in the box of a rapid one, a depth is largest.  Internal to geometry/.
#pragma once

#include "proof/geometry/gouge_path.h"

#include <functional>

namespace feedhold::geometry {

using Depth = std::function<double(const Point<double> &)>;

/// A later point is named only where it is deeper by more than rounding.
inline constexpr double kDeeper = 1e-9;

struct Deepest {
  Point<double> at;
  double depth;
};

/// How a depth changes along a straight line or a curve.
enum class Course : std::uint8_t {
  RisesToEnds, // convex along lines: the deepest point of a line is an end
  RisesToOne,  // along a line up to one point, and falls behind it
  SingleAxes,  // the largest of functions of one coordinate each
  NoFaster,    // it changes by no more than the length of the way
  Any,
};

/// What is looked for.
struct Wanted {
  Depth depth;
  Course course;
  double floor; // deeper than that
  double step;  // between points that are tried, where the course is any
};

/// Absent: nowhere that was found.
std::optional<Deepest> deepestOnPath(const GougePath &path, const Wanted &wanted);
/// In the rectangle between two points, at the Z of `a`.
std::optional<Deepest> deepestInRectangle(const Point<double> &a, const Point<double> &b, const Wanted &wanted);

} // namespace feedhold::geometry
