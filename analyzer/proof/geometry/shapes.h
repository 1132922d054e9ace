// Shapes: tools, regions and other limits of space, over numbers or over terms.
//
// Space is that of the work coordinate system in force at the start of the program, in the units in force.  The point
// of a tool is the middle of its tip.  A tool turns about Z and reaches up without end: it is its cutting end (a disc
// whose rim is rounded by the corner radius) and a shank of its full radius above; a drill is taken without its cone.
//   keep in    The point is in the region, and no part of the tool is outside of the region and all that lies above it.
//   keep out   No part of the tool is in the interior of the region: touching it is allowed.
#pragma once

#include "meaning/semantics/axes.h"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace feedhold::geometry {

/// X, Y, Z
template <typename Number> using Point = std::array<Number, 3>;

/// An absent end is no bound.
template <typename Number> struct Interval {
  std::optional<Number> low = {};
  std::optional<Number> high = {};
  friend bool operator==(const Interval &, const Interval &) = default;
};

template <typename Number> struct Box {
  std::array<Interval<Number>, 3> sides = {}; // X, Y, Z
  friend bool operator==(const Box &, const Box &) = default;
};
template <typename Number> struct Cylinder {
  Axis axis;                    // X, Y or Z
  std::array<Number, 2> centre; // the two other axes, in the order X, Y, Z
  Number radius;
  Interval<Number> along = {};
  friend bool operator==(const Cylinder &, const Cylinder &) = default;
};
template <typename Number> struct Sphere {
  Point<Number> centre;
  Number radius;
  friend bool operator==(const Sphere &, const Sphere &) = default;
};
/// Upright on a polygon, convex or not, whose sides do not cross.
template <typename Number> struct Prism {
  std::vector<std::array<Number, 2>> corners; // X, Y; at least three, either way round
  Interval<Number> height = {};
  friend bool operator==(const Prism &, const Prism &) = default;
};
/// Whether a point is in the region: bool for numbers, a term for terms.
template <typename Number, typename Truth> struct Condition {
  std::function<Truth(const Point<Number> &)> holds;
  /// Nobody can tell.
  friend bool operator==(const Condition &, const Condition &) { return false; }
};

template <typename Number, typename Truth>
using Shape = std::variant<Box<Number>, Cylinder<Number>, Sphere<Number>, Prism<Number>, Condition<Number, Truth>>;

/// A flat end has corner 0, a ball corner = radius.
template <typename Number> struct Tool {
  Number radius;
  Number corner;
  friend bool operator==(const Tool &, const Tool &) = default;
};

} // namespace feedhold::geometry
