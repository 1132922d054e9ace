#include "proof/geometry/quarter_arc.h"

#include "base/support/match.h"

namespace feedhold::geometry {

using smt::Number;
using smt::TermId;
using smt::TermStore;
using Plan = std::array<TermId, 2>; // X, Y

namespace {

/// How far a coordinate lies from the centre in a direction.
TermId along(TermStore &store, const Direction &direction, const Plan &centre, TermId coordinate) {
  const TermId from = centre[direction.axis];
  return direction.isUp ? store.subtract(coordinate, from) : store.subtract(from, coordinate);
}

/// The direction behind this one, as the arc turns: to the left of +X lies +Y, and to the left of +Y lies -X.
Direction next(const Direction &direction, bool isCounterclockwise) {
  const bool leftIsUp = direction.axis == 0 ? direction.isUp : !direction.isUp;
  return {1 - direction.axis, isCounterclockwise ? leftIsUp : !leftIsUp};
}

TermId squareOf(TermStore &store, const Plan &centre, const Plan &point) {
  TermId sum = store.number(Number(0));
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const TermId from = store.subtract(point[axis], centre[axis]);
    sum = store.add(sum, store.multiply(from, from));
  }
  return sum;
}

QuarterArc quarterTowards(TermStore &store, const UprightArc &arc, const Direction &u) {
  const Direction v = next(u, arc.isCounterclockwise);
  const auto at = [&](const Direction &direction, const Plan &point) {
    return along(store, direction, arc.centre, point[direction.axis]);
  };
  const TermId uStart = at(u, arc.start), vStart = at(v, arc.start), uEnd = at(u, arc.end), vEnd = at(v, arc.end);
  std::vector<TermId> parts{store.less(uEnd, uStart), store.less(store.negate(uEnd), uStart), store.less(vStart, vEnd),
                            store.less(store.negate(vStart), vEnd)};
  QuarterArc quarter{arc.centre, {u, v}, {uStart, vEnd}, store.no()};
  if (squareOf(store, arc.centre, arc.start) != squareOf(store, arc.centre, arc.end)) {
    const auto twice = [&](TermId term) { return store.scale(Number(2), term); };
    parts.push_back(store.lessOrEqual(vEnd, twice(uStart)));
    parts.push_back(store.lessOrEqual(uStart, twice(vEnd)));
    quarter.distances.push_back(store.add(vEnd, twice(vStart)));
    quarter.distances.push_back(store.add(uStart, twice(uEnd)));
  }
  quarter.isOne = store.logicalAnd(parts);
  return quarter;
}

class Behind {
public:
  Behind(TermStore &store, const QuarterArc &arc, TermId toolRadius)
      : store_(store), arc_(arc), toolRadius_(toolRadius), zero_(store.number(Number(0))) {}

  std::optional<TermId> of(const Box<TermId> &box) const {
    Plan corner{zero_, zero_}; // the furthest
    for (const Direction &direction : arc_.directions) {
      const Interval<TermId> &side = box.sides[direction.axis];
      const std::optional<TermId> end = direction.isUp ? side.high : side.low;
      if (!end)
        return store_.no();
      corner[direction.axis] = *end;
    }
    return ofDisc(corner, zero_);
  }
  std::optional<TermId> of(const Cylinder<TermId> &cylinder) const {
    return cylinder.axis == Axis::Z ? std::optional(ofDisc(cylinder.centre, cylinder.radius)) : std::nullopt;
  }
  std::optional<TermId> of(const Prism<TermId> &prism) const {
    std::vector<TermId> corners;
    for (const Plan &corner : prism.corners)
      corners.push_back(ofDisc(corner, zero_));
    return store_.logicalAnd(corners);
  }
  std::optional<TermId> of(const Sphere<TermId> &) const { return std::nullopt; }
  std::optional<TermId> of(const Condition<TermId, TermId> &) const { return std::nullopt; }

private:
  /// max(0, u) + max(0, v), the radius of the disc and that of the tool are together no more than each distance.
  TermId ofDisc(const Plan &centre, TermId radius) const {
    const auto &[u, v] = arc_.directions;
    const TermId reach = store_.add(toolRadius_, radius);
    std::vector<TermId> cases;
    for (const TermId distance : arc_.distances)
      for (const TermId first : {zero_, along(store_, u, arc_.centre, centre[u.axis])})
        for (const TermId second : {zero_, along(store_, v, arc_.centre, centre[v.axis])})
          cases.push_back(store_.lessOrEqual(store_.add(reach, store_.add(first, second)), distance));
    return store_.logicalAnd(cases);
  }

  TermStore &store_;
  const QuarterArc &arc_;
  TermId toolRadius_;
  TermId zero_;
};

} // namespace

std::vector<QuarterArc> quarterArcs(TermStore &store, const UprightArc &arc) {
  std::vector<QuarterArc> arcs;
  for (const std::size_t axis : {0U, 1U})
    for (const bool isUp : {true, false})
      if (QuarterArc quarter = quarterTowards(store, arc, {axis, isUp}); quarter.isOne != store.no())
        arcs.push_back(std::move(quarter));
  return arcs;
}

std::optional<TermId> keepsOutBehind(TermStore &store, const QuarterArc &arc, TermId toolRadius,
                                     const Shape<TermId, TermId> &shape) {
  const Behind behind(store, arc, toolRadius);
  return match(shape, [&](const auto &part) { return behind.of(part); });
}

} // namespace feedhold::geometry
