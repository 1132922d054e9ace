// Cutter geometry: what cutter compensation makes of one block and of the corner between two: how far the tool's centre
// lies beside the programmed point, in the plane of the compensation.
//
// At a corner with the directions a (before) and b (behind), seen with the tool on the left, the turn is inner (to the
// tool's side), outer, or none.  Inner corners have one offset vector, the crossing of both offset paths.  Outer ones
// have, by the control, straight pieces (one vector up to a quarter turn, two beyond) or an arc about the corner.
// Sources: docs/run.md#cutter-compensation and parity.md of each dialect.
#pragma once

#include "language/dialect/dialect.h"
#include "meaning/machine/concrete_interpretation.h"

#include <vector>

namespace feedhold {

struct PlaneVector {
  double first = 0;
  double second = 0;
  friend PlaneVector operator+(PlaneVector a, PlaneVector b) { return {a.first + b.first, a.second + b.second}; }
  friend PlaneVector operator-(PlaneVector a, PlaneVector b) { return {a.first - b.first, a.second - b.second}; }
  friend PlaneVector operator*(double factor, PlaneVector v) { return {factor * v.first, factor * v.second}; }
};
double dot(PlaneVector a, PlaneVector b);
double cross(PlaneVector a, PlaneVector b);
double lengthOf(PlaneVector v);

/// On which side of the path the tool goes, seen along it, and how far its centre lies from it: 0 or more.
struct CutterSide {
  int sign = 1; // 1: left, -1: right
  double radius = 0;
  friend bool operator==(const CutterSide &, const CutterSide &) = default;
};

/// A line or an arc of the contour.
struct CutterElement {
  bool isArc = false;
  PlaneVector start;
  PlaneVector end;
  PlaneVector centre; // of an arc, as below
  int way = 1;        // 1: counterclockwise
  double startRadius = 0;
  double endRadius = 0;
  double sweep = 0; // angle from start to end, along its way
  PlaneVector startDirection;
  PlaneVector endDirection;
  PlaneVector startNormal; // to the tool
  PlaneVector endNormal;
};
/// Where a move goes in its plane; the caller knows that it goes somewhere.
CutterElement elementOf(const Move<ConcreteValue> &move, const Plane &plane, int side);
/// Radius of the path of the tool's centre, at the start of an arc; below 0: the tool does not fit.
double centreRadius(const CutterElement &arc, CutterSide side);

enum class CornerTurn : std::uint8_t { None, Inner, Outer, Back };
CornerTurn turnOf(const CutterElement &before, const CutterElement &behind, int side);

struct CutterJoin {
  CornerTurn turn = CornerTurn::None;
  /// From the corner to where the tool's centre is at the end of the first block, and on its way to the second.
  /// Empty: the offset paths do not cross, or one block leads back along the other.
  std::vector<PlaneVector> vectors = {};
  bool isArc = false; // the way between two vectors is an arc about the corner
};
CutterJoin joinOf(const CutterElement &before, const CutterElement &behind, CutterSide side, CutterCorners corners);

} // namespace feedhold
