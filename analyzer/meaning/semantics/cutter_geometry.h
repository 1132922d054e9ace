// Cutter geometry: what cutter compensation makes of one block and of the corner between two: how far the tool's centre
// lies beside the programmed point, in the plane of the compensation.
//
// At a corner with the directions a (before) and b (behind), seen with the tool on the left, the turn is inner (to the
// tool's side), outer, or none.  Inner corners have one offset vector, the crossing of both offset paths.  Outer ones
// have, by the control, straight pieces (one vector up to a quarter turn, two beyond) or an arc about the corner.
// Sources: docs/run.md#cutter-compensation and parity.md of each dialect.
//
// All of it is written once, over a host (docs/architecture.md): numbers of a run, which know of rounding, or terms of
// a proof.  A host has
//
//   Interpretation, Length        what a coordinate of its moves is; lengths are added and multiplied
//   Truth, holds(truth)           what a comparison gives.  A host that cannot tell says no, and remembers that it
//   could
//                                 not (CutterPath): whatever has been computed since is dropped
//   takeUndecided()               what it could not tell (cutter_path.h)
//   none, positive, notPositive, negative (length, tolerance)
//                                 0, above it, not above it, below it; rounding alone brings a length within the
//                                 tolerance
//   signOf(offset)                1 where it is not below 0, -1 where it is; absent: it may be either
//   cannotTell(why)               as for a truth
//   number, magnitude, unit, quotient, least, apart
//   direction(vector)             unit, or the vector itself
//   crossing(normal, normal, radius)  from a corner to where the lines cross that lie the radius beside it along both
//                                 normals; for arcs, beside their tangents
//   sweepOf, turnByAngle, innerCrossing, arcReversed, centreArc
//                                 what needs angles, or the crossing of circles
#pragma once

#include "language/dialect/dialect.h"
#include "meaning/semantics/moves.h"

#include <optional>
#include <vector>

namespace feedhold {

template <typename N> struct PlaneVector {
  N first{};
  N second{};
  friend PlaneVector operator+(PlaneVector a, PlaneVector b) { return {a.first + b.first, a.second + b.second}; }
  friend PlaneVector operator-(PlaneVector a, PlaneVector b) { return {a.first - b.first, a.second - b.second}; }
  friend PlaneVector operator*(N factor, PlaneVector v) { return {factor * v.first, factor * v.second}; }
  friend bool operator==(const PlaneVector &, const PlaneVector &) = default;
};
template <typename N> N dot(PlaneVector<N> a, PlaneVector<N> b) { return a.first * b.first + a.second * b.second; }
template <typename N> N cross(PlaneVector<N> a, PlaneVector<N> b) { return a.first * b.second - a.second * b.first; }
/// Turned by 0, a quarter to the left (1), or to the right (-1).
template <typename N> PlaneVector<N> quarterTurn(PlaneVector<N> v, int side) {
  return side > 0 ? PlaneVector<N>{-v.second, v.first} : PlaneVector<N>{v.second, -v.first};
}
template <typename N> N withSign(int sign, N length) { return sign > 0 ? length : -length; }

/// On which side of the path the tool goes, seen along it, and how far its centre lies from it.
template <typename N> struct CutterSide {
  int sign = 1; // 1: left, -1: right
  N radius{};
  /// The radius may be below 0, and the tool then on the other side.
  bool isOfEitherSign = false;
  /// From the centre to the point that is programmed without compensation: on a lathe, the tip beside the nose.
  PlaneVector<N> tip{};
  friend bool operator==(const CutterSide &, const CutterSide &) = default;
};

/// The plane of a compensation, in which lengths are compared with the radius.
struct CutterPlane {
  Plane axes = kPlaneXY;
  bool byDiameter = false; // coordinates of the second axis are diameters: X of a lathe
};
/// A coordinate along the second axis, as a length in the plane.
template <typename Host>
typename Host::Length secondOf(Host &host, const typename Host::Value &coordinate, const CutterPlane &plane) {
  const typename Host::Length length = host.lengthOf(coordinate);
  return plane.byDiameter ? host.quotient(length, host.number(2)) : length;
}
/// A length in the plane along the second axis, as a coordinate.
template <typename Host>
typename Host::Length secondCoordinate(Host &host, typename Host::Length length, const CutterPlane &plane) {
  return plane.byDiameter ? host.number(2) * length : length;
}

/// A line or an arc of the contour.
template <typename N> struct CutterElement {
  bool isArc = false;
  PlaneVector<N> start;
  PlaneVector<N> end;
  PlaneVector<N> centre; // of an arc, as below
  int way = 1;           // 1: counterclockwise
  N startRadius{};
  N endRadius{};
  double sweep = 0; // angle from start to end, along its way, where the host knows it
  PlaneVector<N> startDirection;
  PlaneVector<N> endDirection;
  PlaneVector<N> startNormal; // to the tool
  PlaneVector<N> endNormal;
};
/// Of the start-up block and the one that ends the compensation it matters only to which side they lead: the directions
/// and normals of a line may have any length.
enum class CutterRole : std::uint8_t { Contour, WayThere };
/// Where a move goes in its plane; the caller knows that it goes somewhere.
template <typename Host>
CutterElement<typename Host::Length> elementOf(Host &host, const Move<typename Host::Value> &move,
                                               const CutterPlane &plane, int side,
                                               CutterRole role = CutterRole::Contour);
/// Radius of the path of the tool's centre, at the start of an arc; below 0: the tool does not fit.
template <typename Host>
typename Host::Length centreRadius(Host &host, const CutterElement<typename Host::Length> &arc,
                                   const CutterSide<typename Host::Length> &side) {
  return host.least(arc.startRadius, arc.endRadius) - withSign(side.sign * arc.way, side.radius);
}

enum class CornerTurn : std::uint8_t { None, Inner, Outer, Back };
template <typename Host>
CornerTurn turnOf(Host &host, const CutterElement<typename Host::Length> &before,
                  const CutterElement<typename Host::Length> &behind, int side);

template <typename N> struct CutterJoin {
  CornerTurn turn = CornerTurn::None;
  /// From the corner to where the tool's centre is at the end of the first block, and on its way to the second.
  /// Empty: the offset paths do not cross, or one block leads back along the other.
  std::vector<PlaneVector<N>> vectors = {};
  bool isArc = false; // the way between two vectors is an arc about the corner
};
template <typename Host>
CutterJoin<typename Host::Length> joinOf(Host &host, const CutterElement<typename Host::Length> &before,
                                         const CutterElement<typename Host::Length> &behind,
                                         const CutterSide<typename Host::Length> &side, CutterCorners corners);

// ---- implementation -----------------------------------------------------------------------------------------------

namespace detail {

/// Sine of a turn that comes from rounding alone.
constexpr double kNoTurn = 1e-9;
/// A turn back by more than 179 degrees: manuals show no common path there.
constexpr double kBack = -0.99985;

template <typename Host, typename N>
PlaneVector<N> tangentAt(Host &host, const CutterElement<N> &arc, PlaneVector<N> point) {
  return host.unit(quarterTurn(point - arc.centre, arc.way));
}

/// Straight pieces.  Beside an arc they begin or end square to it: the arc of the centre keeps its ends.
template <typename Host, typename N>
std::vector<PlaneVector<N>> outerVectors(Host &host, const CutterElement<N> &before, const CutterElement<N> &behind,
                                         N radius) {
  const PlaneVector<N> a = before.endDirection;
  const PlaneVector<N> b = behind.startDirection;
  std::vector<PlaneVector<N>> vectors;
  if (before.isArc)
    vectors.push_back(radius * before.endNormal);
  if (!host.holds(host.negative(dot(a, b), 0))) {
    vectors.push_back(host.crossing(before.endNormal, behind.startNormal, radius));
  } else {
    vectors.push_back(radius * (before.endNormal + a));
    vectors.push_back(radius * (behind.startNormal - b));
  }
  if (behind.isArc)
    vectors.push_back(radius * behind.startNormal);
  return vectors;
}

} // namespace detail

template <typename Host>
CutterElement<typename Host::Length> elementOf(Host &host, const Move<typename Host::Value> &move,
                                               const CutterPlane &plane, int side, CutterRole role) {
  using N = typename Host::Length;
  const auto at = [&](const auto &point) {
    return PlaneVector<N>{host.lengthOf(point[indexOf(plane.axes.first)]),
                          secondOf(host, point[indexOf(plane.axes.second)], plane)};
  };
  CutterElement<N> element;
  element.start = at(move.start);
  element.end = at(move.end);
  element.isArc = isArc(move.kind);
  if (element.isArc) {
    element.way = move.kind == MoveKind::ArcClockwise ? -1 : 1;
    element.centre = {host.lengthOf(move.firstCentre), secondOf(host, move.secondCentre, plane)};
    element.startRadius = host.magnitude(element.start - element.centre);
    element.endRadius = host.magnitude(element.end - element.centre);
    element.sweep = host.sweepOf(element, move.turns);
    element.startDirection = detail::tangentAt(host, element, element.start);
    element.endDirection = detail::tangentAt(host, element, element.end);
  } else {
    const PlaneVector<N> way = element.end - element.start;
    element.startDirection = element.endDirection = role == CutterRole::Contour ? host.unit(way) : host.direction(way);
  }
  element.startNormal = quarterTurn(element.startDirection, side);
  element.endNormal = quarterTurn(element.endDirection, side);
  return element;
}

template <typename Host>
CornerTurn turnOf(Host &host, const CutterElement<typename Host::Length> &before,
                  const CutterElement<typename Host::Length> &behind, int side) {
  using N = typename Host::Length;
  const N sine = withSign(side, cross(before.endDirection, behind.startDirection));
  const N cosine = dot(before.endDirection, behind.startDirection);
  if (host.holds(host.negative(cosine - host.number(detail::kBack), 0)))
    return CornerTurn::Back;
  if (host.holds(host.none(sine, detail::kNoTurn)))
    return CornerTurn::None;
  return host.holds(host.positive(sine, 0)) ? CornerTurn::Inner : CornerTurn::Outer;
}

namespace detail {

/// An inner corner for one sign is an outer one for the other.  Where lines turn by a quarter or less, the centre goes
/// to the same crossing, and where the path does not turn, both have one vector.
template <typename Host>
CutterJoin<typename Host::Length> joinOfEither(Host &host, const CutterElement<typename Host::Length> &before,
                                               const CutterElement<typename Host::Length> &behind,
                                               const CutterSide<typename Host::Length> &side) {
  using N = typename Host::Length;
  const N cosine = dot(before.endDirection, behind.startDirection);
  const bool turnsSharply = host.holds(host.negative(cosine, 0));
  if (!turnsSharply && host.holds(host.none(cross(before.endDirection, behind.startDirection), kNoTurn)))
    return {.vectors = {side.radius * (behind.isArc ? behind.startNormal : before.endNormal)}};
  if (turnsSharply || before.isArc || behind.isArc)
    host.cannotTell(
        "cutter compensation by an offset that may be above or below 0, at a corner beside an arc or of more "
        "than a quarter turn");
  return {.turn = CornerTurn::Inner, .vectors = {host.crossing(before.endNormal, behind.startNormal, side.radius)}};
}

} // namespace detail

template <typename Host>
CutterJoin<typename Host::Length> joinOf(Host &host, const CutterElement<typename Host::Length> &before,
                                         const CutterElement<typename Host::Length> &behind,
                                         const CutterSide<typename Host::Length> &side, CutterCorners corners) {
  using N = typename Host::Length;
  if (side.isOfEitherSign && corners == CutterCorners::Lines)
    return detail::joinOfEither(host, before, behind, side);
  if (side.isOfEitherSign)
    host.cannotTell("cutter compensation by an offset that may be above or below 0, about corners by arcs");
  CutterJoin<N> join{.turn = turnOf(host, before, behind, side.sign)};
  if (join.turn != CornerTurn::Back && host.holds(host.none(side.radius, 0))) {
    join.vectors = {{}};
    return join;
  }
  if (corners == CutterCorners::Arcs)
    join.turn = host.turnByAngle(before, behind, side.sign);
  switch (join.turn) {
  case CornerTurn::None:
    join.vectors = {side.radius *
                    (behind.isArc && corners == CutterCorners::Lines ? behind.startNormal : before.endNormal)};
    break;
  case CornerTurn::Inner:
    if (!before.isArc && !behind.isArc)
      join.vectors = {host.crossing(before.endNormal, behind.startNormal, side.radius)};
    else if (const auto crossing = host.innerCrossing(before, behind, side))
      join.vectors = {*crossing};
    break;
  case CornerTurn::Outer:
    join.isArc = corners == CutterCorners::Arcs;
    join.vectors = join.isArc ? std::vector{side.radius * before.endNormal, side.radius * behind.startNormal}
                              : detail::outerVectors(host, before, behind, side.radius);
    break;
  case CornerTurn::Back: break;
  }
  return join;
}

} // namespace feedhold
