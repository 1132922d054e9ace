#include "proof/space/region_margins.h"

#include "base/support/match.h"

#include <algorithm>

namespace feedhold::prove {

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

bool isPrism(const TermShape &part) { return std::holds_alternative<geometry::Prism<TermId>>(part); }

/// The sides of a polygon do not move, but a flat tool that is smaller comes as much nearer to them.
geometry::Tool<TermId> smaller(TermStore &store, const geometry::Tool<TermId> &tool, TermId tolerance) {
  const TermId zero = store.number(smt::Number(0));
  if (tool.corner != zero || tolerance == zero)
    return tool;
  const TermId rest = store.subtract(tool.radius, tolerance);
  return {store.ite(store.lessOrEqual(zero, rest), rest, zero), zero};
}

} // namespace

TolerantRegion keptInWithin(TermStore &store, const geometry::Tool<TermId> &tool, const std::vector<TermShape> &parts,
                            TermId tolerance) {
  TolerantRegion result{tool, {}};
  const bool hasOthers = std::ranges::any_of(parts, [](const TermShape &part) { return !isPrism(part); });
  if (!hasOthers)
    result.tool = smaller(store, tool, tolerance);
  for (const TermShape &part : parts)
    result.parts.push_back(shrunk(store, part, store.negate(tolerance)));
  return result;
}

std::optional<geometry::Tool<TermId>> eroded(TermStore &store, const geometry::Tool<TermId> &tool, TermId tolerance) {
  const TermId zero = store.number(smt::Number(0));
  const auto less = [&](TermId size) {
    const TermId rest = store.subtract(size, tolerance);
    return store.ite(store.lessOrEqual(zero, rest), rest, zero);
  };
  if (tool.corner == zero)
    return geometry::Tool<TermId>{less(tool.radius), zero};
  if (tool.corner != tool.radius)
    return std::nullopt;
  return geometry::Tool<TermId>{less(tool.radius), less(tool.radius)};
}

} // namespace feedhold::prove
