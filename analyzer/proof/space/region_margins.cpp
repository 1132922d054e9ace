#include "proof/space/region_margins.h"

#include "base/support/match.h"

#include <algorithm>

namespace feedhold::prove {

using geometry::FreeSpace;
using geometry::TermPoint;
using geometry::TermShape;
using smt::TermId;
using smt::TermStore;

TermShape shrunk(TermStore &store, const TermShape &part, TermId margin) {
  const auto within = [&](geometry::Interval<TermId> interval) {
    if (interval.low)
      interval.low = store.add(*interval.low, margin);
    if (interval.high)
      interval.high = store.subtract(*interval.high, margin);
    return interval;
  };
  TermShape result = part;
  match(
      result,
      [&](geometry::Box<TermId> &box) {
        for (geometry::Interval<TermId> &side : box.sides)
          side = within(side);
      },
      [&](geometry::Cylinder<TermId> &cylinder) {
        cylinder.radius = store.subtract(cylinder.radius, margin);
        cylinder.along = within(cylinder.along);
      },
      [&](geometry::Sphere<TermId> &sphere) { sphere.radius = store.subtract(sphere.radius, margin); },
      [&](geometry::Prism<TermId> &prism) { prism.height = within(prism.height); },
      [](geometry::Condition<TermId, TermId> &) {});
  return result;
}

namespace {

using Tool = geometry::Tool<TermId>;

bool isPrism(const TermShape &part) { return std::holds_alternative<geometry::Prism<TermId>>(part); }
bool isCondition(const TermShape &part) { return std::holds_alternative<geometry::Condition<TermId, TermId>>(part); }

/// For a tool whose point is so much higher.
void raiseTool(TermStore &store, FreeSpace &space, TermId height) {
  const auto raise = [&store, height](geometry::Formula &formula) {
    formula = [&store, height, inner = std::move(formula)](const TermPoint &point) {
      return inner({point[0], point[1], store.add(point[2], height)});
    };
  };
  raise(space.all);
  for (std::vector<geometry::Formula> *formulas : {&space.convexParts, &space.bounds})
    for (geometry::Formula &formula : *formulas)
      raise(formula);
  for (FreeSpace::Beyond &beyond : space.beyond)
    beyond = [&store, height, inner = std::move(beyond)](const TermPoint &anchor, const TermPoint &point) {
      return inner({anchor[0], anchor[1], store.add(anchor[2], height)},
                   {point[0], point[1], store.add(point[2], height)});
    };
}

/// What is left of a size; not below 0.
TermId without(TermStore &store, TermId size, TermId layer) {
  const TermId zero = store.number(smt::Number(0));
  const TermId rest = store.subtract(size, layer);
  return store.ite(store.lessOrEqual(zero, rest), rest, zero);
}

/// The sides of a condition, and of a polygon among other shapes or for a tool that is not flat, stay where they are:
/// those of a polygon do not move, but a flat tool that is smaller comes as much nearer to them.
std::vector<FreeSpace> insideWithin(TermStore &store, Tool tool, std::vector<TermShape> parts, TermId tolerance) {
  if (std::ranges::all_of(parts, isPrism) && tool.corner == store.number(smt::Number(0)))
    tool.radius = without(store, tool.radius, tolerance);
  for (TermShape &part : parts)
    part = shrunk(store, part, store.negate(tolerance));
  return {geometry::inside(store, tool, parts)};
}

/// Where the points of a tool that are so deep in it keep out, no part of it is deeper in the region.  Of a flat or a
/// ball tool; another has no tolerance.
std::vector<FreeSpace> outsideWithin(TermStore &store, const Tool &tool, const std::vector<TermShape> &parts,
                                     TermId tolerance) {
  const bool isFlat = tool.corner == store.number(smt::Number(0));
  const bool isKnown = isFlat || tool.corner == tool.radius;
  const TermId radius = without(store, tool.radius, tolerance);
  std::vector<FreeSpace> spaces;
  for (const TermShape &part : parts) {
    spaces.push_back(geometry::outside(store, isKnown ? Tool{radius, isFlat ? tool.corner : radius} : tool, part));
    if (isKnown)
      raiseTool(store, spaces.back(), tolerance);
  }
  return spaces;
}

/// What is so deep in a polygon has a larger tool in it; a condition is asked of all points that are so near.
FreeSpace deepInside(TermStore &store, const Tool &tool, const TermShape &part, TermId distance) {
  if (isCondition(part))
    return geometry::deepIn(store, geometry::inside(store, tool, part), distance);
  const Tool larger{isPrism(part) ? store.add(tool.radius, distance) : tool.radius, tool.corner};
  return geometry::inside(store, larger, shrunk(store, part, distance));
}

/// All that is so near to a tool is a larger one, whose point lies lower by as much.
FreeSpace farOutside(TermStore &store, const Tool &tool, const TermShape &part, TermId distance) {
  FreeSpace space =
      geometry::outside(store, {store.add(tool.radius, distance), store.add(tool.corner, distance)}, part);
  raiseTool(store, space, store.negate(distance));
  return space;
}

} // namespace

bool knowDistances(const std::vector<TermShape> &parts) { return std::ranges::none_of(parts, isCondition); }

std::vector<FreeSpace> insideAt(TermStore &store, const Tool &tool, const std::vector<TermShape> &parts,
                                const smt::Number &distance) {
  if (distance.sign() < 0)
    return insideWithin(store, tool, parts, store.number(-distance));
  if (distance.isZero())
    return {geometry::inside(store, tool, parts)};
  std::vector<FreeSpace> spaces;
  for (const TermShape &part : parts)
    spaces.push_back(deepInside(store, tool, part, store.number(distance)));
  return {geometry::inOneOf(store, std::move(spaces))};
}

std::vector<FreeSpace> outsideAt(TermStore &store, const Tool &tool, const std::vector<TermShape> &parts,
                                 const smt::Number &distance) {
  if (distance.sign() < 0)
    return outsideWithin(store, tool, parts, store.number(-distance));
  std::vector<FreeSpace> spaces;
  for (const TermShape &part : parts)
    spaces.push_back(distance.isZero() ? geometry::outside(store, tool, part)
                                       : farOutside(store, tool, part, store.number(distance)));
  return spaces;
}

} // namespace feedhold::prove
