#include "proof/geometry/polygon_terms.h"

#include "proof/geometry/slope.h"

namespace feedhold::geometry {

using smt::Number;
using smt::TermId;

PolygonTerms::PolygonTerms(smt::TermStore &store, std::vector<Corner> corners)
    : store_(store), corners_(std::move(corners)) {}

/// Above 0 where (x, y) is on the inner side of the line; its distance times the length of the side.
TermId PolygonTerms::cross(std::size_t side, TermId x, TermId y, Turn turn) const {
  return across(wayOf(side), side, x, y, turn);
}

TermId PolygonTerms::across(const Way &way, std::size_t side, TermId x, TermId y, Turn turn) const {
  const TermId left = store_.subtract(store_.multiply(way.x, store_.subtract(y, from(side)[1])),
                                      store_.multiply(way.y, store_.subtract(x, from(side)[0])));
  const TermId inner = turn == Turn::Left ? left : store_.negate(left);
  return way.isOpposite == store_.no() ? inner : store_.ite(way.isOpposite, store_.negate(inner), inner);
}

PolygonTerms::Way PolygonTerms::wayOf(std::size_t side) const {
  return {store_.subtract(to(side)[0], from(side)[0]), store_.subtract(to(side)[1], from(side)[1]), store_.no()};
}

TermId PolygonTerms::length(std::size_t side) const {
  const Way way = wayOf(side);
  return lengthOf(store_, way.x, way.y);
}

/// As long as the numbers of its slope, where it has one; a side of no length may seem to lead anywhere.
std::pair<PolygonTerms::Way, TermId> PolygonTerms::shortWayOf(std::size_t side) const {
  const Way way = wayOf(side);
  const auto slope = slopeOf(store_, way.x, way.y);
  if (!slope)
    return {way, lengthOf(store_, way.x, way.y)};
  return {
      {store_.number(slope->first), store_.number(slope->second), store_.less(slope->times, store_.number(Number(0)))},
      lengthOf(store_, *slope)};
}

/// Of a side of no length it may say no where all corners are on its side.
TermId PolygonTerms::cornersOnSide(std::size_t side, Turn turn) const {
  const Way way = shortWayOf(side).first;
  std::vector<TermId> all;
  for (const auto &[x, y] : corners_)
    all.push_back(store_.lessOrEqual(store_.number(Number(0)), across(way, side, x, y, turn)));
  return store_.logicalAnd(all);
}

bool PolygonTerms::mayTurnAt(std::size_t side, Turn turn) const { return cornersOnSide(side, turn) != store_.no(); }

bool PolygonTerms::mayTurn(Turn turn) const {
  for (std::size_t side = 0; side < corners_.size(); ++side)
    if (!mayTurnAt(side, turn))
      return false;
  return true;
}

bool PolygonTerms::isKnownConvex() const {
  const auto turns = [&](Turn turn) {
    for (std::size_t side = 0; side < corners_.size(); ++side)
      if (cornersOnSide(side, turn) != store_.yes())
        return false;
    return true;
  };
  return mayTurn(Turn::Left) != mayTurn(Turn::Right) && (turns(Turn::Left) || turns(Turn::Right));
}

TermId PolygonTerms::deepIn(const Point &point, Turn turn, TermId distance) const {
  std::vector<TermId> all;
  for (std::size_t side = 0; side < corners_.size(); ++side) {
    const auto [way, length] = shortWayOf(side);
    all.push_back(cornersOnSide(side, turn));
    all.push_back(store_.lessOrEqual(store_.multiply(distance, length), across(way, side, point[0], point[1], turn)));
  }
  return store_.logicalAnd(all);
}

TermId PolygonTerms::beyond(const Point &point, std::size_t side, Turn turn, TermId distance) const {
  const auto [way, span] = shortWayOf(side);
  const std::array all{
      cornersOnSide(side, turn), store_.less(store_.number(Number(0)), length(side)),
      store_.lessOrEqual(across(way, side, point[0], point[1], turn), store_.negate(store_.multiply(distance, span)))};
  return store_.logicalAnd(all);
}

TermId PolygonTerms::contains(const Point &point) const {
  TermId odd = store_.no();
  for (std::size_t side = 0; side < corners_.size(); ++side) {
    const TermId startAbove = store_.less(point[1], from(side)[1]);
    const TermId endAbove = store_.less(point[1], to(side)[1]);
    const TermId zero = store_.number(Number(0));
    const TermId turn = cross(side, point[0], point[1], Turn::Left);
    // A side that goes down has its left on the right: the line to the right crosses it when the point is left of it.
    const TermId down =
        store_.logicalAnd(store_.logicalAnd(startAbove, store_.logicalNot(endAbove)), store_.less(turn, zero));
    const TermId up =
        store_.logicalAnd(store_.logicalAnd(store_.logicalNot(startAbove), endAbove), store_.less(zero, turn));
    const TermId crosses = store_.logicalOr(down, up);
    odd = store_.logicalOr(store_.logicalAnd(odd, store_.logicalNot(crosses)),
                           store_.logicalAnd(store_.logicalNot(odd), crosses));
  }
  return odd;
}

TermId PolygonTerms::keepsFrom(std::size_t side, const Point &point, TermId distance) const {
  const TermId zero = store_.number(Number(0));
  const auto squares = [&](TermId x, TermId y) { return store_.add(store_.multiply(x, x), store_.multiply(y, y)); };
  const TermId ex = store_.subtract(to(side)[0], from(side)[0]);
  const TermId ey = store_.subtract(to(side)[1], from(side)[1]);
  const TermId x = store_.subtract(point[0], from(side)[0]);
  const TermId y = store_.subtract(point[1], from(side)[1]);
  const TermId along = store_.add(store_.multiply(ex, x), store_.multiply(ey, y));
  const TermId whole = squares(ex, ey);
  const TermId across = cross(side, point[0], point[1], Turn::Left);
  const TermId far = store_.multiply(distance, distance);
  const TermId beside = store_.lessOrEqual(store_.multiply(far, whole), store_.multiply(across, across));
  const auto notNear = [&](TermId px, TermId py) { return store_.lessOrEqual(far, squares(px, py)); };
  const std::array cases{
      beside, store_.logicalAnd(store_.lessOrEqual(along, zero), notNear(x, y)),
      store_.logicalAnd(store_.lessOrEqual(whole, along), notNear(store_.subtract(x, ex), store_.subtract(y, ey)))};
  return store_.logicalOr(cases);
}

TermId PolygonTerms::keepsFromSides(const Point &point, TermId distance) const {
  std::vector<TermId> all;
  for (std::size_t side = 0; side < corners_.size(); ++side)
    all.push_back(keepsFrom(side, point, distance));
  return store_.logicalAnd(all);
}

TermId PolygonTerms::isSimple() const {
  std::vector<std::size_t> sides; // a corner that is written twice makes none
  for (std::size_t side = 0; side < corners_.size(); ++side)
    if (from(side) != to(side))
      sides.push_back(side);
  std::vector<TermId> all;
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (std::size_t j = i + 2; j < sides.size(); ++j)
      if (i != 0 || j + 1 != sides.size())
        all.push_back(store_.logicalOr(isApart(sides[i], sides[j]), isApart(sides[j], sides[i])));
  return store_.logicalAnd(all);
}

/// Both ends of the other side lie left of the line of a side, or right of it, or before its start, or behind its end.
TermId PolygonTerms::isApart(std::size_t side, std::size_t other) const {
  const TermId zero = store_.number(Number(0));
  const TermId ex = store_.subtract(to(side)[0], from(side)[0]);
  const TermId ey = store_.subtract(to(side)[1], from(side)[1]);
  const auto along = [&](const Corner &corner) {
    return store_.add(store_.multiply(ex, store_.subtract(corner[0], from(side)[0])),
                      store_.multiply(ey, store_.subtract(corner[1], from(side)[1])));
  };
  const auto both = [&](auto &&holds) { return store_.logicalAnd(holds(from(other)), holds(to(other))); };
  const auto beside = [&](Turn turn) {
    return both([&](const Corner &corner) { return store_.less(zero, cross(side, corner[0], corner[1], turn)); });
  };
  const std::array cases{beside(Turn::Left), beside(Turn::Right),
                         both([&](const Corner &corner) { return store_.less(along(corner), zero); }),
                         both([&](const Corner &corner) { return store_.less(along(to(side)), along(corner)); })};
  return store_.logicalOr(cases);
}

TermId PolygonTerms::hasArea() const {
  TermId twice = store_.number(Number(0));
  for (std::size_t side = 0; side < corners_.size(); ++side)
    twice = store_.add(twice, store_.subtract(store_.multiply(from(side)[0], to(side)[1]),
                                              store_.multiply(to(side)[0], from(side)[1])));
  return store_.notEqual(twice, store_.number(Number(0)));
}

} // namespace feedhold::geometry
