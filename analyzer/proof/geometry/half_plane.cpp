#include "proof/geometry/half_plane.h"

#include "base/support/check.h"

#include <array>

namespace feedhold::geometry {

namespace {

constexpr std::size_t kX = indexOf(Axis::X), kY = indexOf(Axis::Y), kZ = indexOf(Axis::Z);

bool leavesPlane(const Move<ConcreteValue> &move) {
  return move.start[kY].number != move.end[kY].number || (isArc(move.kind) && move.plane.first != Axis::Z);
}

} // namespace

TipDirection tipDirection(std::uint8_t number) {
  constexpr std::array<TipDirection, 9> kDirections = {
      {{0, 0}, {1, 1}, {1, -1}, {-1, -1}, {-1, 1}, {0, 1}, {1, 0}, {0, -1}, {-1, 0}}};
  FEEDHOLD_CHECK(number < kDirections.size(), "the reader of contracts lets only these numbers pass");
  return kDirections[number];
}

RecordedMove inHalfPlane(RecordedMove recorded, const TipDirection &direction, double radius) {
  Move<ConcreteValue> &move = recorded.move;
  recorded.isOfTool = recorded.isOfTool && !leavesPlane(move);
  const std::array<double, 2> toCentre = {-radius * direction.z, -radius * direction.x};
  for (auto *point : {&move.start, &move.end}) {
    const double z = (*point)[kZ].number, x = (*point)[kX].number;
    point->fill(ConcreteValue::of(0));
    (*point)[0] = ConcreteValue::of(z + toCentre[0]);
    (*point)[1] = ConcreteValue::of(x / 2 + toCentre[1]);
  }
  move.firstCentre = ConcreteValue::of(move.firstCentre.number + toCentre[0]);
  move.secondCentre = ConcreteValue::of(move.secondCentre.number / 2 + toCentre[1]);
  move.plane = kPlaneXY;
  recorded.zero = {recorded.zero[kZ], recorded.zero[kX] / 2, 0};
  recorded.centre.clear();
  return recorded;
}

Point<double> fromHalfPlane(const Point<double> &centre, const TipDirection &direction, double radius) {
  return {2 * (centre[1] + radius * direction.x), 0, centre[0] + radius * direction.z};
}

} // namespace feedhold::geometry
