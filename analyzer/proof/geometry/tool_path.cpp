#include "proof/geometry/tool_path.h"

#include "proof/geometry/slope.h"

#include <cmath>

namespace feedhold::geometry {

using smt::Number;

namespace {

std::size_t in(Axis axis) { return indexOf(axis); }

/// A number not below the root of this one, and no more than a millionth above it, as far as doubles tell; absent:
/// there is none.
std::optional<Number> aboveRoot(const Number &square) {
  constexpr double kParts = 1 << 20;
  const double root = std::sqrt(square.toDouble());
  if (!std::isfinite(root) || root * kParts > 1e15)
    return std::nullopt;
  const Number above = Number::fromDouble((std::floor(root * kParts) + 1) / kParts);
  return above * above < square ? std::nullopt : std::optional(above);
}

} // namespace

ToolPath::ToolPath(TermStore &store, TermMove move) : store_(store), move_(move) {
  if (isArc() && move_.radius && findCentre())
    move_.radius.reset();
}

TermId ToolPath::share(PointOnPath &onPath) {
  const TermId share = freshVariable(store_, "share of the path");
  onPath.conditions.push_back(store_.lessOrEqual(store_.number(Number(0)), share));
  onPath.conditions.push_back(store_.lessOrEqual(share, store_.number(Number(1))));
  return share;
}

TermId ToolPath::between(PointOnPath &onPath, TermId start, TermId end) {
  if (start == end)
    return start;
  return store_.add(start, store_.multiply(share(onPath), store_.subtract(end, start)));
}

PointOnPath ToolPath::anyPoint() {
  if (isArc())
    return pointOfArc();
  return isBox() ? pointOfBox() : pointOfLine();
}

PointOnPath ToolPath::pointOfLine() {
  PointOnPath onPath{move_.start, {}};
  const TermId part = move_.start == move_.end ? store_.number(Number(0)) : share(onPath);
  for (std::size_t i = 0; i < onPath.point.size(); ++i)
    onPath.point[i] = store_.add(move_.start[i], store_.multiply(part, store_.subtract(move_.end[i], move_.start[i])));
  return onPath;
}

PointOnPath ToolPath::pointOfBox() {
  PointOnPath onPath{move_.start, {}};
  for (std::size_t i = 0; i < onPath.point.size(); ++i)
    onPath.point[i] = between(onPath, move_.start[i], move_.end[i]);
  return onPath;
}

ToolPath::Spokes ToolPath::spokes() const {
  const auto from = [&](const TermPoint &point, Axis axis, TermId centre) {
    return store_.subtract(point[in(axis)], centre);
  };
  const auto &[first, second, normal, i, j] = move_.plane;
  return {from(move_.start, first, move_.firstCentre), from(move_.start, second, move_.secondCentre),
          from(move_.end, first, move_.firstCentre), from(move_.end, second, move_.secondCentre)};
}

TermId ToolPath::square(TermId first, TermId second) const {
  return store_.add(store_.multiply(first, first), store_.multiply(second, second));
}

/// The point (x, y) from the centre lies between the ends, on the side to which the arc turns.  Where both ends are in
/// one direction, the arc is a full circle.
TermId ToolPath::sector(TermId x, TermId y) const {
  Spokes ends = spokes();
  if (move_.turns > 1 || (ends.startFirst == ends.endFirst && ends.startSecond == ends.endSecond))
    return store_.yes();
  if (move_.kind == MoveKind::ArcClockwise) {
    std::swap(ends.startFirst, ends.endFirst);
    std::swap(ends.startSecond, ends.endSecond);
  }
  const TermId zero = store_.number(Number(0));
  const auto cross = [&](TermId ax, TermId ay, TermId bx, TermId by) {
    return store_.subtract(store_.multiply(ax, by), store_.multiply(ay, bx));
  };
  const TermId turn = cross(ends.startFirst, ends.startSecond, ends.endFirst, ends.endSecond);
  const TermId dot =
      store_.add(store_.multiply(ends.startFirst, ends.endFirst), store_.multiply(ends.startSecond, ends.endSecond));
  const TermId behindStart = store_.lessOrEqual(zero, cross(ends.startFirst, ends.startSecond, x, y));
  const TermId beforeEnd = store_.lessOrEqual(zero, cross(x, y, ends.endFirst, ends.endSecond));
  const TermId shorter = store_.less(zero, turn);
  const TermId half = store_.logicalAnd(store_.equal(turn, zero), store_.less(dot, zero));
  const TermId longer = store_.less(turn, zero);
  const TermId full = store_.logicalAnd(store_.equal(turn, zero), store_.lessOrEqual(zero, dot));
  const std::array cases{store_.logicalAnd(shorter, store_.logicalAnd(behindStart, beforeEnd)),
                         store_.logicalAnd(half, behindStart),
                         store_.logicalAnd(longer, store_.logicalOr(behindStart, beforeEnd)), full};
  return store_.logicalOr(cases);
}

/// What follows from the circle and its sector: seen along the chord, all of an arc lies to the right of it when it
/// turns to the left.  The chord of a full circle is a point.
TermId ToolPath::besideChord(TermId x, TermId y) const {
  Spokes ends = spokes();
  if (move_.kind == MoveKind::ArcClockwise) {
    std::swap(ends.startFirst, ends.endFirst);
    std::swap(ends.startSecond, ends.endSecond);
  }
  const TermId right =
      store_.multiply(store_.subtract(ends.endSecond, ends.startSecond), store_.subtract(x, ends.startFirst));
  const TermId left =
      store_.multiply(store_.subtract(ends.endFirst, ends.startFirst), store_.subtract(y, ends.startSecond));
  return store_.lessOrEqual(left, right);
}

/// R says the distance of the centre from both ends, and the side of the chord on which it lies: these polynomial facts
/// are of more use than the formula of the centre.  Where R is shorter than half the chord, the arc is a half circle
/// about the middle of it; where the ends are one, there is none.
PointOnPath ToolPath::pointOfArcByRadius() {
  ToolPath about = *this;
  about.move_.radius.reset();
  about.move_.firstCentre = freshVariable(store_, "centre");
  about.move_.secondCentre = freshVariable(store_, "centre");
  const Spokes ends = about.spokes();
  PointOnPath onPath = about.pointOfArc();
  const TermId zero = store_.number(Number(0));
  const TermId chordFirst = store_.subtract(ends.endFirst, ends.startFirst);
  const TermId chordSecond = store_.subtract(ends.endSecond, ends.startSecond);
  const TermId chord = square(chordFirst, chordSecond);
  const TermId diameter = store_.scale(Number(4), store_.multiply(move_.radius->size, move_.radius->size));
  const TermId distance = store_.scale(Number(4), square(ends.startFirst, ends.startSecond));
  const std::array reaches{store_.lessOrEqual(chord, diameter), store_.equal(distance, diameter)};
  const std::array tooShort{store_.less(diameter, chord), store_.equal(distance, chord)};
  const TermId left = store_.subtract(store_.multiply(chordFirst, store_.negate(ends.startSecond)),
                                      store_.multiply(chordSecond, store_.negate(ends.startFirst)));
  const TermId inner = centreIsLeft() ? left : store_.negate(left);
  const std::array arc{store_.equal(square(ends.startFirst, ends.startSecond), square(ends.endFirst, ends.endSecond)),
                       store_.logicalOr(store_.logicalAnd(reaches), store_.logicalAnd(tooShort)),
                       store_.lessOrEqual(zero, inner), store_.less(zero, chord)};
  const std::size_t first = in(move_.plane.first);
  const std::size_t second = in(move_.plane.second);
  const std::array none{store_.equal(chord, zero), store_.equal(onPath.point[first], move_.start[first]),
                        store_.equal(onPath.point[second], move_.start[second])};
  onPath.conditions.push_back(store_.logicalOr(store_.logicalAnd(arc), store_.logicalAnd(none)));
  return onPath;
}

/// Seen along the chord, the centre of the shorter arc lies to the right of a clockwise one.
bool ToolPath::centreIsLeft() const {
  return (move_.kind == MoveKind::ArcCounterclockwise) == (move_.radius->length == ArcLength::Short);
}

/// Of a quarter or three quarters from axis to axis, and of a half along an axis, by the form of its terms.
bool ToolPath::findCentre() {
  const std::size_t first = in(move_.plane.first);
  const std::size_t second = in(move_.plane.second);
  const TermId a = store_.subtract(move_.end[first], move_.start[first]);
  const TermId b = store_.subtract(move_.end[second], move_.start[second]);
  const TermId zero = store_.number(Number(0));
  const auto isTimes = [&](TermId term, int factor) {
    return term == store_.scale(Number(factor), move_.radius->size);
  };
  const auto isHalf = [&](TermId along, TermId across) {
    return across == zero && (isTimes(along, 2) || isTimes(along, -2));
  };
  const auto middle = [&](std::size_t axis) {
    return store_.scale(Number(1) / Number(2), store_.add(move_.start[axis], move_.end[axis]));
  };
  if (isHalf(a, b) || isHalf(b, a)) {
    move_.firstCentre = middle(first);
    move_.secondCentre = middle(second);
    return true;
  }
  if ((!isTimes(a, 1) && !isTimes(a, -1)) || (!isTimes(b, 1) && !isTimes(b, -1)))
    return false;
  const bool sameSign = isTimes(a, 1) == isTimes(b, 1);
  const bool aboveStart =
      sameSign == centreIsLeft(); // in the first coordinate where it starts, in the other where it ends
  move_.firstCentre = aboveStart ? move_.start[first] : move_.end[first];
  move_.secondCentre = aboveStart ? move_.end[second] : move_.start[second];
  return true;
}

PointOnPath ToolPath::pointOfArc() {
  if (move_.radius)
    return pointOfArcByRadius();
  PointOnPath onPath{move_.start, {}};
  const Spokes ends = spokes();
  const TermId x = freshVariable(store_, "arc");
  const TermId y = freshVariable(store_, "arc");
  const TermId distance = square(x, y);
  const TermId atStart = square(ends.startFirst, ends.startSecond);
  const TermId atEnd = square(ends.endFirst, ends.endSecond);
  const auto within = [&](TermId low, TermId high) {
    return store_.logicalAnd(store_.lessOrEqual(low, distance), store_.lessOrEqual(distance, high));
  };
  onPath.conditions.push_back(atStart == atEnd ? store_.equal(distance, atStart)
                                               : store_.logicalOr(within(atStart, atEnd), within(atEnd, atStart)));
  onPath.conditions.push_back(sector(x, y));
  if (atStart == atEnd && move_.turns <= 1)
    onPath.conditions.push_back(besideChord(x, y));
  onPath.point[in(move_.plane.first)] = store_.add(move_.firstCentre, x);
  onPath.point[in(move_.plane.second)] = store_.add(move_.secondCentre, y);
  const std::size_t normal = in(move_.plane.normal);
  onPath.point[normal] = between(onPath, move_.start[normal], move_.end[normal]);
  return onPath;
}

ToolPath::Hull ToolPath::hull() {
  if (isArc())
    return arcHull();
  if (isBox())
    return boxHull();
  return {{move_.start, move_.end}, {}};
}

ToolPath::Hull ToolPath::boxHull() const {
  Hull hull{{move_.start}, {}};
  for (std::size_t i = 0; i < move_.start.size(); ++i) {
    if (move_.start[i] == move_.end[i])
      continue;
    const std::vector<TermPoint> before = hull.corners;
    for (TermPoint corner : before) {
      corner[i] = move_.end[i];
      hull.corners.push_back(corner);
    }
  }
  return hull;
}

TermPoint ToolPath::atCentre(TermPoint point) const {
  point[in(move_.plane.first)] = move_.firstCentre;
  point[in(move_.plane.second)] = move_.secondCentre;
  return point;
}

std::vector<QuarterArc> ToolPath::quarters() const {
  if (!isUprightArc() || move_.turns > 1)
    return {};
  return quarterArcs(store_, {{move_.firstCentre, move_.secondCentre},
                              {move_.start[0], move_.start[1]},
                              {move_.end[0], move_.end[1]},
                              move_.kind == MoveKind::ArcCounterclockwise});
}

/// The box around the full circle; of an arc whose ends are not as far from the centre, around the larger one.
ToolPath::Hull ToolPath::arcHull() {
  const Spokes ends = spokes();
  const auto radiusOf = [&](TermId first, TermId second) {
    const smt::Term &radicand = store_[square(first, second)];
    if (radicand.kind == smt::TermKind::Number && !exactSquareRoot(radicand.number))
      if (const std::optional<Number> above = aboveRoot(radicand.number)) // a larger box will do, and folds
        return store_.number(*above);
    return lengthOf(store_, first, second);
  };
  const TermId atStart = radiusOf(ends.startFirst, ends.startSecond);
  const TermId atEnd = radiusOf(ends.endFirst, ends.endSecond);
  Hull hull;
  TermId radius = atStart;
  if (const TermId isLarger = store_.less(atStart, atEnd); isLarger == store_.yes())
    radius = atEnd;
  else if (isLarger != store_.no()) {
    radius = freshVariable(store_, "radius");
    hull.conditions.push_back(
        store_.logicalAnd(store_.lessOrEqual(atStart, radius), store_.lessOrEqual(atEnd, radius)));
    hull.conditions.push_back(store_.logicalOr(store_.equal(radius, atStart), store_.equal(radius, atEnd)));
    hull.example.emplace_back(radius, store_.ite(store_.less(atStart, atEnd), atEnd, atStart));
  }
  const std::size_t normal = in(move_.plane.normal);
  std::vector<TermId> levels{move_.start[normal]};
  if (move_.end[normal] != move_.start[normal])
    levels.push_back(move_.end[normal]);
  for (const TermId level : levels)
    for (const TermId x : {radius, store_.negate(radius)})
      for (const TermId y : {radius, store_.negate(radius)}) {
        TermPoint corner = move_.start;
        corner[in(move_.plane.first)] = store_.add(move_.firstCentre, x);
        corner[in(move_.plane.second)] = store_.add(move_.secondCentre, y);
        corner[normal] = level;
        hull.corners.push_back(corner);
      }
  return hull;
}

} // namespace feedhold::geometry
