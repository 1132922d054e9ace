#include "proof/geometry/half_plane.h"

#include <cstddef>

namespace feedhold::geometry {

namespace {

constexpr std::size_t kX = indexOf(Axis::X), kY = indexOf(Axis::Y), kZ = indexOf(Axis::Z);

bool leavesPlane(const Move<ConcreteValue> &move) {
  return move.start[kY].number != move.end[kY].number || (isArc(move.kind) && move.plane.first != Axis::Z);
}

} // namespace

RecordedMove inHalfPlane(RecordedMove recorded, const TipDirection &direction, double radius) {
  Move<ConcreteValue> &move = recorded.move;
  recorded.isOfTool = recorded.isOfTool && !leavesPlane(move);
  for (auto *point : {&move.start, &move.end}) {
    const auto laid = toHalfPlane({(*point)[kX].number, 0, (*point)[kZ].number}, direction, radius);
    for (std::size_t i = 0; i < point->size(); ++i)
      (*point)[i] = ConcreteValue::of(i < laid.size() ? laid[i] : 0);
  }
  const auto centre = toHalfPlane({move.secondCentre.number, 0, move.firstCentre.number}, direction, radius);
  move.firstCentre = ConcreteValue::of(centre[0]);
  move.secondCentre = ConcreteValue::of(centre[1]);
  move.plane = kPlaneXY;
  recorded.zero = {recorded.zero[kZ], recorded.zero[kX] / 2, 0};
  recorded.centre.clear();
  return recorded;
}

Point<double> toHalfPlane(const Point<double> &programmed, const TipDirection &direction, double radius) {
  return {programmed[kZ] - radius * direction.z, programmed[kX] / 2 - radius * direction.x, 0};
}

Point<double> fromHalfPlane(const Point<double> &centre, const TipDirection &direction, double radius) {
  return {2 * (centre[1] + radius * direction.x), 0, centre[0] + radius * direction.z};
}

} // namespace feedhold::geometry
