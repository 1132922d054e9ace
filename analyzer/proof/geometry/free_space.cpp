#include "proof/geometry/free_space.h"

#include "base/support/match.h"
#include "proof/geometry/polygon_terms.h"

#include <fmt/format.h>

namespace feedhold::geometry {

using smt::Number;
using smt::Sort;

TermId freshVariable(TermStore &store, std::string_view what) {
  return store.variable(fmt::format("{} {}", what, store.size()), Sort::Real);
}

namespace {

/// Formulas about one tool.
class SpaceOf {
public:
  SpaceOf(TermStore &store, const Tool<TermId> &tool)
      : store_(store), radius_(tool.radius), corner_(tool.corner), disc_(store.subtract(tool.radius, tool.corner)),
        zero_(store.number(Number(0))) {}

  // ---- to keep in ----

  FreeSpace inside(const Box<TermId> &box) const {
    return convex({[=, this](const TermPoint &p) { return within(shrunk(box.sides[0]), p[0]); },
                   [=, this](const TermPoint &p) { return within(shrunk(box.sides[1]), p[1]); },
                   [=, this](const TermPoint &p) { return within(box.sides[2], p[2]); }});
  }
  FreeSpace inside(const Cylinder<TermId> &cylinder) const {
    if (cylinder.axis == Axis::Z) {
      FreeSpace space = convex({[=, this](const TermPoint &p) {
                                  return isWithin(store_.subtract(cylinder.radius, radius_),
                                                  from(p[0], cylinder.centre[0]), from(p[1], cylinder.centre[1]));
                                },
                                [=, this](const TermPoint &p) { return within(cylinder.along, p[2]); }});
      space.around = [=, this](const TermPoint &centre, const std::vector<TermPoint> &ends) {
        return circlesInside(cylinder, store_.subtract(cylinder.radius, radius_), centre, ends);
      };
      return space;
    }
    const auto [along, across] = lying(cylinder);
    const Formula lengthwise = [=, this, i = along](const TermPoint &p) {
      return within(shrunk(cylinder.along), p[i]);
    };
    const Formula around = [=, this, i = across](const TermPoint &p) {
      const TermId e = from(p[i], cylinder.centre[0]);
      const TermId h = from(store_.add(p[2], corner_), cylinder.centre[1]);
      const TermId room = squared(store_.subtract(cylinder.radius, corner_));
      const TermId deep = store_.logicalAnd(notBelow(room, sumOfSquares(store_.add(e, disc_), h)),
                                            notBelow(room, sumOfSquares(store_.subtract(disc_, e), h)));
      const TermId sides = store_.subtract(cylinder.radius, radius_);
      const std::array parts{notBelow(sides, e), notBelow(sides, store_.negate(e)),
                             store_.logicalOr(notBelow(h, zero_), deep),
                             notBelow(squared(cylinder.radius), sumOfSquares(e, from(p[2], cylinder.centre[1])))};
      return store_.logicalAnd(parts);
    };
    return convex({lengthwise, around});
  }
  FreeSpace inside(const Sphere<TermId> &sphere) const {
    return convex({[=, this](const TermPoint &p) {
      const TermId level = sumOfSquares(from(p[0], sphere.centre[0]), from(p[1], sphere.centre[1]));
      const TermId h = from(store_.add(p[2], corner_), sphere.centre[2]);
      const TermId reach = disc_ == zero_ ? level : squared(store_.add(root(level), disc_));
      const TermId deep = notBelow(squared(store_.subtract(sphere.radius, corner_)), store_.add(reach, squared(h)));
      const TermId room = store_.subtract(sphere.radius, radius_);
      const std::array parts{
          notBelow(room, zero_), notBelow(squared(room), level), store_.logicalOr(notBelow(h, zero_), deep),
          notBelow(squared(sphere.radius), store_.add(level, squared(from(p[2], sphere.centre[2]))))};
      return store_.logicalAnd(parts);
    }});
  }
  FreeSpace inside(const Prism<TermId> &prism) const {
    const PolygonTerms polygon(store_, prism.corners);
    const auto upright = [=, this](const Formula &plan) {
      return [=, this](const TermPoint &p) { return store_.logicalAnd(within(prism.height, p[2]), plan(p)); };
    };
    FreeSpace space;
    for (const Turn turn : {Turn::Left, Turn::Right})
      if (polygon.mayTurn(turn))
        space.convexParts.push_back(
            upright([=, this](const TermPoint &p) { return polygon.deepIn(p, turn, radius_); }));
    if (polygon.isKnownConvex())
      return convex(space.convexParts);
    space.all = upright([=, this](const TermPoint &p) {
      return store_.logicalAnd(polygon.contains(p), polygon.keepsFromSides(p, radius_));
    });
    return space;
  }
  /// All points of the tool's end.
  FreeSpace inside(const Condition<TermId, TermId> &condition) const {
    return {{}, [=, this](const TermPoint &p) { return ofEnd(p, condition.holds); }};
  }

  // ---- to keep out of ----

  FreeSpace outside(const Box<TermId> &box) const {
    FreeSpace space;
    for (std::size_t i = 0; i < 2; ++i) {
      if (const auto low = box.sides[i].low)
        space.convexParts.push_back(half([=, this](const TermPoint &p) { return store_.subtract(*low, p[i]); }));
      if (const auto high = box.sides[i].high)
        space.convexParts.push_back(half([=, this](const TermPoint &p) { return store_.subtract(p[i], *high); }));
    }
    addAbove(space, box.sides[2].high);
    if (space.convexParts.size() == 1) // a half space
      return convex(space.convexParts);
    space.all = [=, this](const TermPoint &p) { return outsideOfBox(p, box, space.convexParts); };
    return space;
  }
  FreeSpace outside(const Cylinder<TermId> &cylinder) const {
    FreeSpace space;
    const TermId reach = store_.add(cylinder.radius, radius_);
    if (cylinder.axis == Axis::Z) {
      addAround(space, {cylinder.centre[0], cylinder.centre[1]}, reach);
      addAbove(space, cylinder.along.high);
      space.all = [=, this](const TermPoint &p) {
        const TermId far =
            notBelow(sumOfSquares(from(p[0], cylinder.centre[0]), from(p[1], cylinder.centre[1])), squared(reach));
        return cylinder.along.high ? store_.logicalOr(far, notBelow(p[2], *cylinder.along.high)) : far;
      };
      space.beyond.push_back([=, this](const TermPoint &anchor, const TermPoint &p) {
        const auto spoke = [&](const TermPoint &to) {
          return std::vector{from(to[0], cylinder.centre[0]), from(to[1], cylinder.centre[1])};
        };
        return beyondPlane(spoke(anchor), spoke(p), reach);
      });
      space.around = [=, this](const TermPoint &centre, const std::vector<TermPoint> &ends) {
        return circlesOutside(cylinder, reach, centre, ends);
      };
      return space;
    }
    const auto [along, across] = lying(cylinder);
    if (const auto low = cylinder.along.low)
      space.convexParts.push_back(
          half([=, this, i = along](const TermPoint &p) { return store_.subtract(*low, p[i]); }));
    if (const auto high = cylinder.along.high)
      space.convexParts.push_back(
          half([=, this, i = along](const TermPoint &p) { return store_.subtract(p[i], *high); }));
    const auto e = [=, this, i = across](const TermPoint &p) { return from(p[i], cylinder.centre[0]); };
    space.convexParts.push_back([=, this](const TermPoint &p) { return notBelow(e(p), reach); });
    space.convexParts.push_back([=, this](const TermPoint &p) { return notBelow(store_.negate(e(p)), reach); });
    addAbove(space, store_.add(cylinder.centre[1], cylinder.radius));
    space.all = [=, this](const TermPoint &p) {
      const TermId h = from(store_.add(p[2], corner_), cylinder.centre[1]);
      const TermId grown = squared(store_.add(cylinder.radius, corner_));
      std::vector<TermId> cases;
      for (const Formula &part : space.convexParts)
        cases.push_back(part(p));
      if (disc_ == zero_) {
        cases.push_back(store_.logicalAnd(notBelow(h, zero_), notBelow(sumOfSquares(e(p), h), grown)));
        return store_.logicalOr(cases);
      }
      for (const TermId side : {e(p), store_.negate(e(p))}) {
        const TermId gap = store_.subtract(side, disc_);
        const std::array beside{notBelow(h, zero_), notBelow(gap, zero_), notBelow(sumOfSquares(gap, h), grown)};
        cases.push_back(store_.logicalAnd(beside));
      }
      return store_.logicalOr(cases);
    };
    if (disc_ == zero_)
      space.beyond.push_back([=, this](const TermPoint &anchor, const TermPoint &p) {
        const auto spoke = [&](const TermPoint &to) {
          return std::vector{e(to), from(store_.add(to[2], corner_), cylinder.centre[1])};
        };
        return store_.logicalAnd(notBelow(spoke(anchor).back(), zero_), beyondPlane(spoke(anchor), spoke(p), reach));
      });
    return space;
  }
  FreeSpace outside(const Sphere<TermId> &sphere) const {
    FreeSpace space;
    const TermId reach = store_.add(sphere.radius, radius_);
    addAround(space, {sphere.centre[0], sphere.centre[1]}, reach);
    addAbove(space, store_.add(sphere.centre[2], sphere.radius));
    space.all = [=, this](const TermPoint &p) {
      const TermId level = sumOfSquares(from(p[0], sphere.centre[0]), from(p[1], sphere.centre[1]));
      const TermId h = from(store_.add(p[2], corner_), sphere.centre[2]);
      const TermId gap = disc_ == zero_ ? zero_ : store_.subtract(root(level), disc_);
      const TermId distance = disc_ == zero_ ? level : squared(gap);
      const std::array above{notBelow(h, zero_), notBelow(gap, zero_),
                             notBelow(store_.add(distance, squared(h)), squared(store_.add(sphere.radius, corner_)))};
      const std::array cases{notBelow(level, squared(reach)),
                             notBelow(p[2], store_.add(sphere.centre[2], sphere.radius)), store_.logicalAnd(above)};
      return store_.logicalOr(cases);
    };
    if (disc_ == zero_)
      space.beyond.push_back([=, this](const TermPoint &anchor, const TermPoint &p) {
        const auto spoke = [&](const TermPoint &to) {
          return std::vector{from(to[0], sphere.centre[0]), from(to[1], sphere.centre[1]),
                             from(store_.add(to[2], corner_), sphere.centre[2])};
        };
        return store_.logicalAnd(notBelow(spoke(anchor).back(), zero_), beyondPlane(spoke(anchor), spoke(p), reach));
      });
    return space;
  }
  FreeSpace outside(const Prism<TermId> &prism) const {
    const PolygonTerms polygon(store_, prism.corners);
    FreeSpace space;
    for (std::size_t side = 0; side < prism.corners.size(); ++side)
      for (const Turn turn : {Turn::Left, Turn::Right})
        if (polygon.mayTurnAt(side, turn))
          space.convexParts.push_back([=, this](const TermPoint &p) { return polygon.beyond(p, side, turn, radius_); });
    addAbove(space, prism.height.high);
    space.all = [=, this](const TermPoint &p) {
      std::vector<TermId> cases{
          store_.logicalAnd(store_.logicalNot(polygon.contains(p)), polygon.keepsFromSides(p, radius_))};
      for (const Formula &part : space.convexParts)
        cases.push_back(part(p));
      return store_.logicalOr(cases);
    };
    return space;
  }
  /// All points of a flat tool, which has every other one of its radius in it.
  FreeSpace outside(const Condition<TermId, TermId> &condition) const {
    return {{}, [=, this](const TermPoint &p) {
              const auto [point, kept] = inDisc(p, radius_);
              const TermId up = freshVariable(store_, "up the shank");
              const TermId holds = condition.holds({point[0], point[1], store_.add(point[2], up)});
              return store_.implies(store_.logicalAnd(kept, notBelow(up, zero_)), store_.logicalNot(holds));
            }};
  }

private:
  FreeSpace convex(std::vector<Formula> bounds) const {
    const Formula all = [this, bounds](const TermPoint &p) {
      std::vector<TermId> parts;
      for (const Formula &bound : bounds)
        parts.push_back(bound(p));
      return store_.logicalAnd(parts);
    };
    return {{all}, all, bounds};
  }

  // ---- terms ----

  TermId notBelow(TermId a, TermId b) const { return store_.lessOrEqual(b, a); }
  TermId from(TermId coordinate, TermId centre) const { return store_.subtract(coordinate, centre); }
  TermId squared(TermId term) const { return store_.multiply(term, term); }
  TermId sumOfSquares(TermId a, TermId b) const { return store_.add(squared(a), squared(b)); }
  TermId root(TermId term) const { return store_.apply(smt::Function::Sqrt, term); }
  TermId within(const Interval<TermId> &interval, TermId coordinate) const {
    const TermId above = interval.low ? notBelow(coordinate, *interval.low) : store_.yes();
    return interval.high ? store_.logicalAnd(above, notBelow(*interval.high, coordinate)) : above;
  }
  Interval<TermId> shrunk(Interval<TermId> interval) const {
    if (interval.low)
      interval.low = store_.add(*interval.low, radius_);
    if (interval.high)
      interval.high = store_.subtract(*interval.high, radius_);
    return interval;
  }

  // ---- circles about an upright axis ----

  /// The point (a, b) is no further than the room from the axis; beside it along one coordinate alone, without squares.
  TermId isWithin(TermId room, TermId a, TermId b) const {
    if (a == zero_ || b == zero_)
      return sizesAtMost(room, {a == zero_ ? b : a});
    return store_.logicalAnd(notBelow(room, zero_), notBelow(squared(room), sumOfSquares(a, b)));
  }
  /// Each sum of the terms with either sign is at most the bound: so is the sum of their sizes.
  TermId sizesAtMost(TermId bound, const std::vector<TermId> &terms) const {
    std::vector<TermId> sums{zero_};
    for (const TermId term : terms) {
      if (term == zero_)
        continue;
      std::vector<TermId> longer;
      for (const TermId sum : sums) {
        longer.push_back(store_.add(sum, term));
        longer.push_back(store_.subtract(sum, term));
      }
      sums = std::move(longer);
    }
    std::vector<TermId> cases;
    for (const TermId sum : sums)
      cases.push_back(notBelow(bound, sum));
    return store_.logicalAnd(cases);
  }
  /// A circle about a centre that is off the axis: no point is further from the axis than the distance of the centre
  /// and the radius together, and neither is longer than the sum of its coordinates.
  TermId circlesInside(const Cylinder<TermId> &cylinder, TermId room, const TermPoint &centre,
                       const std::vector<TermPoint> &ends) const {
    std::vector<TermId> cases;
    for (const TermPoint &end : ends)
      cases.push_back(sizesAtMost(room, {from(centre[0], cylinder.centre[0]), from(centre[1], cylinder.centre[1]),
                                         from(end[0], centre[0]), from(end[1], centre[1])}));
    return store_.logicalAnd(cases);
  }
  /// No point is nearer to the axis than the radius without the distance of the centre, and no coordinate is longer
  /// than the radius.
  TermId circlesOutside(const Cylinder<TermId> &cylinder, TermId reach, const TermPoint &centre,
                        const std::vector<TermPoint> &ends) const {
    const std::vector<TermId> off{from(centre[0], cylinder.centre[0]), from(centre[1], cylinder.centre[1])};
    std::vector<TermId> all;
    for (const TermPoint &end : ends) {
      std::vector<TermId> cases;
      for (std::size_t axis = 0; axis < 2; ++axis)
        for (const TermId radius : {from(end[axis], centre[axis]), from(centre[axis], end[axis])})
          cases.push_back(sizesAtMost(store_.subtract(radius, reach), off));
      all.push_back(store_.logicalOr(cases));
    }
    return store_.logicalAnd(all);
  }

  // ---- regions to keep out of ----

  /// With both as seen from the centre: the point is no nearer than the anchor in the direction of the anchor, which is
  /// so far away itself.
  TermId beyondPlane(const std::vector<TermId> &anchor, const std::vector<TermId> &point, TermId reach) const {
    TermId further = zero_; // anchor * (point - anchor)
    TermId square = zero_;
    std::vector<TermId> perAxis; // for one coordinate: without the product
    for (std::size_t i = 0; i < anchor.size(); ++i) {
      const TermId change = store_.subtract(point[i], anchor[i]);
      square = store_.add(square, squared(anchor[i]));
      if (change == zero_)
        continue;
      further = store_.add(further, store_.multiply(anchor[i], change));
      perAxis.push_back(store_.logicalOr(store_.logicalAnd(notBelow(anchor[i], zero_), notBelow(change, zero_)),
                                         store_.logicalAnd(notBelow(zero_, anchor[i]), notBelow(zero_, change))));
    }
    const TermId isBeyond = perAxis.size() == 1 ? perAxis.front() : notBelow(further, zero_);
    return store_.logicalAnd(isBeyond, notBelow(square, squared(reach)));
  }
  /// Where a distance from a flat side is at least the radius.
  template <typename Distance> Formula half(Distance distance) const {
    return [=, this](const TermPoint &p) { return notBelow(distance(p), radius_); };
  }
  void addAbove(FreeSpace &space, std::optional<TermId> top) const {
    if (top)
      space.convexParts.push_back([=, this](const TermPoint &p) { return notBelow(p[2], *top); });
  }
  /// Beside a circle: the four half planes along the axes.
  void addAround(FreeSpace &space, const std::array<TermId, 2> &centre, TermId reach) const {
    for (std::size_t i = 0; i < 2; ++i) {
      space.convexParts.push_back([=, this](const TermPoint &p) { return notBelow(from(p[i], centre[i]), reach); });
      space.convexParts.push_back([=, this](const TermPoint &p) { return notBelow(from(centre[i], p[i]), reach); });
    }
  }
  /// Beside it, above it, beyond a corner, or with a round end above its rim.
  TermId outsideOfBox(const TermPoint &p, const Box<TermId> &box, const std::vector<Formula> &parts) const {
    std::vector<TermId> cases;
    for (const Formula &part : parts)
      cases.push_back(part(p));
    std::array<std::vector<TermId>, 2> gaps;
    for (std::size_t i = 0; i < 2; ++i) {
      if (box.sides[i].low)
        gaps[i].push_back(store_.subtract(*box.sides[i].low, p[i]));
      if (box.sides[i].high)
        gaps[i].push_back(store_.subtract(p[i], *box.sides[i].high));
    }
    for (const TermId x : gaps[0])
      for (const TermId y : gaps[1]) {
        const std::array corner{notBelow(x, zero_), notBelow(y, zero_), notBelow(sumOfSquares(x, y), squared(radius_))};
        cases.push_back(store_.logicalAnd(corner));
      }
    if (box.sides[2].high && corner_ != zero_) {
      const TermId h = from(store_.add(p[2], corner_), *box.sides[2].high);
      for (const auto &side : gaps)
        for (const TermId gap : side) {
          const TermId beside = store_.subtract(gap, disc_);
          const std::array rim{notBelow(h, zero_), notBelow(beside, zero_),
                               notBelow(sumOfSquares(beside, h), squared(corner_))};
          cases.push_back(store_.logicalAnd(rim));
        }
    }
    return store_.logicalOr(cases);
  }

  struct Lying {
    std::size_t along;
    std::size_t across;
  };
  /// Of a cylinder about X or Y: its centre is given on the other of the two, then on Z.
  static Lying lying(const Cylinder<TermId> &cylinder) {
    const std::size_t along = indexOf(cylinder.axis);
    return {along, 1 - along};
  }

  // ---- points of the tool ----

  struct Within {
    TermPoint point;
    TermId kept; // the new variables lie where they may
  };
  Within inDisc(const TermPoint &p, TermId radius) const {
    const TermId x = freshVariable(store_, "of the tool");
    const TermId y = freshVariable(store_, "of the tool");
    return {{store_.add(p[0], x), store_.add(p[1], y), p[2]}, notBelow(squared(radius), sumOfSquares(x, y))};
  }
  TermId ofEnd(const TermPoint &p, const std::function<TermId(const TermPoint &)> &holds) const {
    auto [point, kept] = inDisc(p, disc_);
    if (corner_ == zero_)
      return store_.implies(kept, holds(point));
    const TermId x = freshVariable(store_, "of the tool");
    const TermId y = freshVariable(store_, "of the tool");
    const TermId z = freshVariable(store_, "of the tool");
    const std::array conditions{kept, notBelow(zero_, z),
                                notBelow(squared(corner_), store_.add(sumOfSquares(x, y), squared(z)))};
    const TermPoint lowest{store_.add(point[0], x), store_.add(point[1], y),
                           store_.add(store_.add(point[2], corner_), z)};
    return store_.implies(store_.logicalAnd(conditions), holds(lowest));
  }

  TermStore &store_;
  TermId radius_;
  TermId corner_;
  TermId disc_; // radius of the flat part of the end
  TermId zero_;
};

/// Formulas outlive the call: they own what they are made of.
template <typename Make> FreeSpace owning(TermStore &store, const Tool<TermId> &tool, Make make) {
  const auto maker = std::make_shared<SpaceOf>(store, tool);
  FreeSpace space = make(*maker);
  const auto keep = [maker](Formula &formula) {
    formula = [maker, inner = std::move(formula)](const TermPoint &p) { return inner(p); };
  };
  keep(space.all);
  for (FreeSpace::Beyond &beyond : space.beyond)
    beyond = [maker, inner = std::move(beyond)](const TermPoint &anchor, const TermPoint &p) {
      return inner(anchor, p);
    };
  if (space.around)
    space.around = [maker, inner = *std::move(space.around)](
                       const TermPoint &centre, const std::vector<TermPoint> &ends) { return inner(centre, ends); };
  for (std::vector<Formula> *formulas : {&space.convexParts, &space.bounds})
    for (Formula &formula : *formulas)
      keep(formula);
  return space;
}

} // namespace

FreeSpace inside(TermStore &store, const Box<TermId> &box) {
  const TermId zero = store.number(Number(0));
  return inside(store, {zero, zero}, TermShape(box));
}

FreeSpace inside(TermStore &store, const Tool<TermId> &tool, const TermShape &part) {
  return owning(store, tool,
                [&](const SpaceOf &of) { return match(part, [&](const auto &shape) { return of.inside(shape); }); });
}

FreeSpace inside(TermStore &store, const Tool<TermId> &tool, const std::vector<TermShape> &region) {
  std::vector<FreeSpace> spaces;
  for (const TermShape &part : region)
    spaces.push_back(inside(store, tool, part));
  return inOneOf(store, std::move(spaces));
}

FreeSpace inOneOf(TermStore &store, std::vector<FreeSpace> spaces) {
  if (spaces.size() == 1)
    return std::move(spaces.front());
  FreeSpace all;
  std::vector<Formula> each;
  for (FreeSpace &space : spaces) {
    each.push_back(space.all);
    for (Formula &part : space.convexParts)
      all.convexParts.push_back(std::move(part));
  }
  all.all = [&store, each](const TermPoint &p) {
    std::vector<TermId> cases;
    for (const Formula &formula : each)
      cases.push_back(formula(p));
    return store.logicalOr(cases);
  };
  return all;
}

FreeSpace deepIn(TermStore &store, FreeSpace space, TermId distance) {
  return {{}, [&store, distance, inner = std::move(space.all)](const TermPoint &p) {
            TermPoint beside = p;
            TermId square = store.number(Number(0));
            for (TermId &coordinate : beside) {
              const TermId away = freshVariable(store, "beside the path");
              coordinate = store.add(coordinate, away);
              square = store.add(square, store.multiply(away, away));
            }
            return store.implies(store.lessOrEqual(square, store.multiply(distance, distance)), inner(beside));
          }};
}

FreeSpace outside(TermStore &store, const Tool<TermId> &tool, const TermShape &part) {
  FreeSpace space = owning(store, tool, [&](const SpaceOf &of) {
    return match(part, [&](const auto &shape) { return of.outside(shape); });
  });
  space.behindQuarter = [&store, radius = tool.radius, part](const QuarterArc &arc) {
    return keepsOutBehind(store, arc, radius, part);
  };
  space.isOpenUpwards = true; // the tool reaches up without end: higher up, less of it is there
  return space;
}

TermId isTool(TermStore &store, const Tool<TermId> &tool) {
  return store.logicalAnd(store.lessOrEqual(store.number(Number(0)), tool.corner),
                          store.lessOrEqual(tool.corner, tool.radius));
}

TermId isNotEmpty(TermStore &store, const TermShape &part) {
  const TermId zero = store.number(Number(0));
  const auto open = [&](const Interval<TermId> &interval) {
    return interval.low && interval.high ? store.less(*interval.low, *interval.high) : store.yes();
  };
  return match(
      part,
      [&](const Box<TermId> &box) {
        const std::array sides{open(box.sides[0]), open(box.sides[1]), open(box.sides[2])};
        return store.logicalAnd(sides);
      },
      [&](const Cylinder<TermId> &cylinder) {
        return store.logicalAnd(store.less(zero, cylinder.radius), open(cylinder.along));
      },
      [&](const Sphere<TermId> &sphere) { return store.less(zero, sphere.radius); },
      [&](const Prism<TermId> &prism) {
        const PolygonTerms polygon(store, prism.corners);
        const std::array parts{polygon.hasArea(), polygon.isSimple(), open(prism.height)};
        return store.logicalAnd(parts);
      },
      [&](const Condition<TermId, TermId> &) { return store.yes(); });
}

} // namespace feedhold::geometry
