#include "meaning/machine/cutter_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace feedhold {

namespace {

/// Sine of a turn that comes from rounding alone.
constexpr double kNoTurn = 1e-9;
/// A turn back by more than 179 degrees: manuals show no common path there.
constexpr double kBack = -0.99985;
/// Where corners are arcs: a smaller turn is none, and one that misses the way back by less goes round the outside
/// (TOLERANCE_CONCAVE_CORNER in interp_convert.cc of LinuxCNC), in radians.
constexpr double kSmallTurn = 0.05;
/// Offset paths that miss one another by less are those of elements that touch, but for the rounding of their ends.
constexpr double kTouch = 1e-3;

PlaneVector unit(PlaneVector v) { return 1 / lengthOf(v) * v; }
PlaneVector toSide(PlaneVector direction, int side) { return side * PlaneVector{-direction.second, direction.first}; }

PlaneVector tangentAt(const CutterElement &arc, PlaneVector point) {
  const PlaneVector spoke = point - arc.centre;
  return unit(arc.way * PlaneVector{-spoke.second, spoke.first});
}

double sweepOf(const CutterElement &arc, std::uint32_t turns) {
  constexpr double kFullCircle = 2 * std::numbers::pi;
  const PlaneVector from = arc.start - arc.centre;
  const PlaneVector to = arc.end - arc.centre;
  double angle = arc.way * std::atan2(cross(from, to), dot(from, to));
  if (lengthOf(arc.end - arc.start) < 1e-7)
    angle = kFullCircle;
  else if (angle < 0)
    angle += kFullCircle;
  return angle + kFullCircle * (turns - 1.0);
}

/// The path of the centre beside an element, without its ends.
struct OffsetCurve {
  bool isCircle;
  PlaneVector point; // of a line; or the centre
  PlaneVector direction;
  double radius;
};
OffsetCurve curveAtEnd(const CutterElement &element, CutterSide side) {
  if (element.isArc)
    return {true, element.centre, {}, element.endRadius - side.sign * element.way * side.radius};
  return {false, element.end + side.radius * element.endNormal, element.endDirection, 0};
}
OffsetCurve curveAtStart(const CutterElement &element, CutterSide side) {
  if (element.isArc)
    return {true, element.centre, {}, element.startRadius - side.sign * element.way * side.radius};
  return {false, element.start + side.radius * element.startNormal, element.startDirection, 0};
}

using Crossings = std::vector<PlaneVector>;
Crossings lineAndCircle(const OffsetCurve &line, const OffsetCurve &circle) {
  const PlaneVector from = line.point - circle.point;
  const double along = dot(from, line.direction);
  const double aside = cross(line.direction, from);
  const double square = circle.radius * circle.radius - aside * aside;
  if (circle.radius < 0 || square < 0)
    return {};
  const double half = std::sqrt(square);
  return {line.point + (-along - half) * line.direction, line.point + (-along + half) * line.direction};
}
Crossings circles(const OffsetCurve &a, const OffsetCurve &b) {
  const PlaneVector between = b.point - a.point;
  const double distance = lengthOf(between);
  if (a.radius < 0 || b.radius < 0 || distance < kNoTurn)
    return {};
  const double along = (distance * distance + a.radius * a.radius - b.radius * b.radius) / (2 * distance);
  const double square = a.radius * a.radius - along * along;
  if (square < 0)
    return {};
  const PlaneVector direction = unit(between);
  const PlaneVector middle = a.point + along * direction;
  const PlaneVector aside = std::sqrt(square) * PlaneVector{-direction.second, direction.first};
  return {middle + aside, middle - aside};
}
Crossings crossingsOf(const OffsetCurve &a, const OffsetCurve &b) {
  if (a.isCircle && b.isCircle)
    return circles(a, b);
  return a.isCircle ? lineAndCircle(b, a) : lineAndCircle(a, b);
}

/// Where both offset lines, or those of the tangents at the corner, cross.
PlaneVector mitre(const CutterElement &before, const CutterElement &behind, double radius) {
  const double cosine = dot(before.endDirection, behind.startDirection);
  return radius / (1 + cosine) * (before.endNormal + behind.startNormal);
}

/// How far a point of the offset path lies ahead of that beside a point of the element; in radians for an arc.
double wayFrom(const CutterElement &element, PlaneVector from, PlaneVector point) {
  if (!element.isArc)
    return dot(point - from, element.endDirection);
  const PlaneVector spoke = from - element.centre;
  const PlaneVector other = point - element.centre;
  return element.way * std::atan2(cross(spoke, other), dot(spoke, other));
}

std::vector<PlaneVector> innerVectors(const CutterElement &before, const CutterElement &behind, CutterSide side) {
  if (!before.isArc && !behind.isArc)
    return {mitre(before, behind, side.radius)};
  Crossings all = crossingsOf(curveAtEnd(before, side), curveAtStart(behind, side));
  // An inner corner shortens both elements.
  const auto lengthens = [&](PlaneVector point) {
    return wayFrom(before, before.end, point) > kTouch || wayFrom(behind, behind.start, point) < -kTouch;
  };
  if (!std::all_of(all.begin(), all.end(), lengthens))
    all.erase(std::remove_if(all.begin(), all.end(), lengthens), all.end());
  const auto fromCorner = [&](PlaneVector point) { return lengthOf(point - before.end); };
  const auto nearest = std::min_element(all.begin(), all.end(),
                                        [&](PlaneVector a, PlaneVector b) { return fromCorner(a) < fromCorner(b); });
  if (nearest != all.end())
    return {*nearest - before.end};
  if (lengthOf(side.radius * (before.endNormal - behind.startNormal)) < kTouch)
    return {side.radius * (behind.isArc ? behind.startNormal : before.endNormal)};
  return {};
}

/// Straight pieces.  Beside an arc they begin or end square to it: the arc of the centre keeps its ends.
std::vector<PlaneVector> outerVectors(const CutterElement &before, const CutterElement &behind, double radius) {
  const PlaneVector a = before.endDirection;
  const PlaneVector b = behind.startDirection;
  std::vector<PlaneVector> vectors;
  if (before.isArc)
    vectors.push_back(radius * before.endNormal);
  if (dot(a, b) >= 0) {
    vectors.push_back(mitre(before, behind, radius));
  } else {
    vectors.push_back(radius * (before.endNormal + a));
    vectors.push_back(radius * (behind.startNormal - b));
  }
  if (behind.isArc)
    vectors.push_back(radius * behind.startNormal);
  return vectors;
}

CornerTurn turnByAngle(const CutterElement &before, const CutterElement &behind, int side) {
  const PlaneVector a = before.endDirection;
  const PlaneVector b = behind.startDirection;
  const double angle = side * std::atan2(cross(a, b), dot(a, b));
  if (std::abs(angle) < kSmallTurn)
    return CornerTurn::None;
  if (std::abs(angle) > std::numbers::pi - kSmallTurn) // back along the same way, where an arc bends to the tool
    return behind.isArc && side * behind.way < 0 ? CornerTurn::Inner : CornerTurn::Outer;
  return angle > 0 ? CornerTurn::Inner : CornerTurn::Outer;
}

} // namespace

double dot(PlaneVector a, PlaneVector b) { return a.first * b.first + a.second * b.second; }
double cross(PlaneVector a, PlaneVector b) { return a.first * b.second - a.second * b.first; }
double lengthOf(PlaneVector v) { return std::hypot(v.first, v.second); }

CutterElement elementOf(const Move<ConcreteValue> &move, const Plane &plane, int side) {
  const auto at = [&](const std::array<ConcreteValue, kAxisCount> &point) {
    return PlaneVector{point[indexOf(plane.first)].number, point[indexOf(plane.second)].number};
  };
  CutterElement element;
  element.start = at(move.start);
  element.end = at(move.end);
  element.isArc = isArc(move.kind);
  if (element.isArc) {
    element.way = move.kind == MoveKind::ArcClockwise ? -1 : 1;
    element.centre = {move.firstCentre.number, move.secondCentre.number};
    element.startRadius = lengthOf(element.start - element.centre);
    element.endRadius = lengthOf(element.end - element.centre);
    element.sweep = sweepOf(element, move.turns);
    element.startDirection = tangentAt(element, element.start);
    element.endDirection = tangentAt(element, element.end);
  } else {
    element.startDirection = element.endDirection = unit(element.end - element.start);
  }
  element.startNormal = toSide(element.startDirection, side);
  element.endNormal = toSide(element.endDirection, side);
  return element;
}

double centreRadius(const CutterElement &arc, CutterSide side) {
  return std::min(arc.startRadius, arc.endRadius) - side.sign * arc.way * side.radius;
}

CornerTurn turnOf(const CutterElement &before, const CutterElement &behind, int side) {
  const double sine = side * cross(before.endDirection, behind.startDirection);
  const double cosine = dot(before.endDirection, behind.startDirection);
  if (cosine < kBack)
    return CornerTurn::Back;
  if (std::abs(sine) < kNoTurn)
    return CornerTurn::None;
  return sine > 0 ? CornerTurn::Inner : CornerTurn::Outer;
}

CutterJoin joinOf(const CutterElement &before, const CutterElement &behind, CutterSide side, CutterCorners corners) {
  CutterJoin join{.turn = turnOf(before, behind, side.sign)};
  if (side.radius == 0 && join.turn != CornerTurn::Back) {
    join.vectors = {{}};
    return join;
  }
  if (corners == CutterCorners::Arcs)
    join.turn = turnByAngle(before, behind, side.sign);
  switch (join.turn) {
  case CornerTurn::None:
    join.vectors = {side.radius *
                    (behind.isArc && corners == CutterCorners::Lines ? behind.startNormal : before.endNormal)};
    break;
  case CornerTurn::Inner: join.vectors = innerVectors(before, behind, side); break;
  case CornerTurn::Outer:
    join.isArc = corners == CutterCorners::Arcs;
    join.vectors = join.isArc ? std::vector{side.radius * before.endNormal, side.radius * behind.startNormal}
                              : outerVectors(before, behind, side.radius);
    break;
  case CornerTurn::Back: break;
  }
  return join;
}

} // namespace feedhold
