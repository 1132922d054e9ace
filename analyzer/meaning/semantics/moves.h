// Move: what the machine does with its axes, in terms that no control's codes show through: the canonical tool path.
#pragma once

#include "meaning/semantics/axes.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace feedhold {

enum class MoveKind : std::uint8_t {
  Rapid,
  Feed,
  ArcClockwise, // seen from the positive end of the plane's normal
  ArcCounterclockwise,
  CutInBox, // strokes at feed and at rapid, in any order, anywhere in the box between its ends; a run has the strokes
  Dwell,
  Probe,      // towards a signal: may end anywhere on the way
  Unmodelled, // its path is not known; nor need it lead from `start` to `end`
};
std::string_view nameOf(MoveKind kind);
inline bool isArc(MoveKind kind) { return kind == MoveKind::ArcClockwise || kind == MoveKind::ArcCounterclockwise; }

/// Coordinates are those of the active work coordinate system, in the units in force, without tool compensation.
template <typename Value> struct Move {
  MoveKind kind = MoveKind::Rapid;
  std::array<Value, kAxisCount> start{};
  std::array<Value, kAxisCount> end{};
  Plane plane = kPlaneXY; // of an arc
  Value firstCentre{};    // of an arc, and of a cycle about a centre: coordinates in its plane
  Value secondCentre{};
  std::uint32_t turns = 1; // of an arc: a full circle more for each above 1
  Value feed{};            // F in force; of Dwell: the time as programmed
  /// Of a cycle that takes the offset of D itself (circle_pocket.h): the ends that it moves towards the centre.
  bool offsetsStart = false;
  bool offsetsEnd = false;
  /// The line before a corner, or the corner itself (corners.h): told with the line behind it, and not part of that.
  bool leadsToLine = false;
  /// Of a rapid move: its axes are interpolated.  Otherwise each may be positioned by itself.
  bool isInterpolated = false;
};

/// `isSame` says of two coordinates that they are equal, for certain.
template <typename Value, typename IsSame> bool mayMove(const Move<Value> &move, Axis axis, const IsSame &isSame) {
  return !isSame(move.start[indexOf(axis)], move.end[indexOf(axis)]);
}

/// It may be anywhere in the box between its ends.
template <typename Value> bool isInBox(const Move<Value> &move) {
  return move.kind == MoveKind::CutInBox || (move.kind == MoveKind::Rapid && !move.isInterpolated);
}

/// The same move elsewhere.  `by`: how far, along X, Y and Z; `add` adds such a length to a coordinate.
template <typename Value, typename Length, typename Add>
Move<Value> displaced(Move<Value> move, const std::array<Length, 3> &by, const Add &add) {
  for (std::size_t i = 0; i < by.size(); ++i) {
    add(move.start[i], by[i]);
    add(move.end[i], by[i]);
  }
  const auto along = [&](Axis axis) { return indexOf(axis) < by.size() ? by[indexOf(axis)] : Length{}; };
  if (isArc(move.kind)) {
    add(move.firstCentre, along(move.plane.first));
    add(move.secondCentre, along(move.plane.second));
  }
  return move;
}

} // namespace feedhold
