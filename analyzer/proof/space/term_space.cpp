#include "proof/space/term_space.h"

namespace feedhold::prove {

using smt::TermId;

TermSpace TermSpace::ofProgrammed() const {
  TermSpace programmed = *this;
  if (programmed.tip_)
    programmed.tip_->radius = store_.number(smt::Number(0));
  return programmed;
}

TermId TermSpace::radius(TermId diameter) const { return store_.divide(diameter, store_.number(smt::Number(2))); }

/// The centre of the nose lies on the other side of the tip.
TermId TermSpace::fromTip(TermId coordinate, int direction) const {
  return direction == 0  ? coordinate
         : direction > 0 ? store_.subtract(coordinate, tip_->radius)
                         : store_.add(coordinate, tip_->radius);
}

geometry::TermPoint TermSpace::point(TermId x, TermId y, TermId z) const {
  if (!tip_)
    return {x, y, z};
  return {fromTip(z, tip_->direction.z), fromTip(radius(x), tip_->direction.x), store_.number(smt::Number(0))};
}

geometry::TermPoint TermSpace::point(const std::array<SymbolicValue, kAxisCount> &position,
                                     const std::array<SymbolicValue, 3> &zero) const {
  const auto at = [&](std::size_t i) { return store_.add(position[i].number, zero[i].number); };
  return point(at(0), at(1), at(2));
}

geometry::TermMove TermSpace::move(const MoveInstance &instance) const {
  const Move<SymbolicValue> &move = instance.move;
  geometry::TermMove result{move.kind, point(move.start, instance.point.zero), point(move.end, instance.point.zero),
                            isInBox(move), tip_ ? kPlaneXY : move.plane};
  if (!isArc(move.kind))
    return result;
  std::array<TermId, 3> centre{store_.number(smt::Number(0)), store_.number(smt::Number(0)),
                               store_.number(smt::Number(0))};
  const auto take = [&](Axis axis, const SymbolicValue &coordinate) {
    centre[indexOf(axis)] = store_.add(coordinate.number, instance.point.zero[indexOf(axis)].number);
  };
  take(move.plane.first, move.firstCentre);
  take(move.plane.second, move.secondCentre);
  const geometry::TermPoint there = point(centre[0], centre[1], centre[2]);
  result.firstCentre = there[indexOf(result.plane.first)];
  result.secondCentre = there[indexOf(result.plane.second)];
  result.turns = move.turns;
  result.radius = instance.radius;
  return result;
}

} // namespace feedhold::prove
