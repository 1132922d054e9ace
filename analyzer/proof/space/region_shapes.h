// Region shapes: the geometry clauses of a contract as shapes over whatever its expressions are read to.
#pragma once

#include "base/support/match.h"
#include "language/contract/contract.h"
#include "proof/geometry/shapes.h"

#include <functional>
#include <optional>
#include <variant>
#include <vector>

namespace feedhold::prove {

/// Between the diameters of a lathe and the radii of its space (half_plane.h), which are below 0 across the axis.
template <typename Number> struct Diameters {
  std::function<Number(Number)> half;
  std::function<Number(Number)> twice;
  std::function<Number(Number)> minus;
  std::function<Number(Number)> magnitude;
  Number zero;
};

/// `number` and `holds` read the expressions of the contract: a value on entry, a condition at a point.
template <typename Number, typename Truth> struct RegionShapes {
  using Shape = geometry::Shape<Number, Truth>;
  std::function<Number(ExpressionId)> number;
  std::function<Truth(ExpressionId, const geometry::Point<Number> &)> holds;
  std::optional<Diameters<Number>> lathe = {}; // absent: a machining centre

  Shape keptIn(const Region &region) const {
    Shape shape = this->shape(region);
    auto *box = lathe ? std::get_if<geometry::Box<Number>>(&shape) : nullptr;
    if (box && box->sides[1].high && !box->sides[1].low)
      box->sides[1].low = lathe->minus(*box->sides[1].high);
    return shape;
  }
  /// A region of a lathe lies all round its axis: also where X is below 0.  One without a lower end of X reaches there.
  std::vector<Shape> keptOut(const Region &region) const {
    std::vector<Shape> parts{shape(region)};
    if (lathe)
      if (std::optional<Shape> other = acrossAxis(parts.front()))
        parts.push_back(std::move(*other));
    return parts;
  }
  Shape shape(const Region &region) const {
    return match(
        region.shape, [&](const Box &box) -> Shape { return sides(box); },
        [&](const Cylinder &cylinder) -> Shape {
          const Axis axis = *axisOf(cylinder.axis);
          const Axis first = axis == Axis::X ? Axis::Y : Axis::X;
          const Axis second = axis == Axis::Z ? Axis::Y : Axis::Z;
          return geometry::Cylinder<Number>{axis,
                                            {on(cylinder.centre, first), on(cylinder.centre, second)},
                                            number(cylinder.radius),
                                            interval(cylinder.along)};
        },
        [&](const Sphere &sphere) -> Shape {
          return geometry::Sphere<Number>{
              {on(sphere.centre, Axis::X), on(sphere.centre, Axis::Y), on(sphere.centre, Axis::Z)},
              number(sphere.radius)};
        },
        [&](const Polygon &polygon) -> Shape {
          geometry::Prism<Number> prism{{}, interval(polygon.height)};
          for (const Polygon::Corner &corner : polygon.corners)
            prism.corners.push_back(lathe ? std::array{number(corner.second), lathe->half(number(corner.first))}
                                          : std::array{number(corner.first), number(corner.second)});
          return prism;
        },
        [&](const Where &where) -> Shape {
          return geometry::Condition<Number, Truth>{
              [holds = holds, lathe = lathe, condition = where.condition](const geometry::Point<Number> &point) {
                return holds(condition, lathe ? geometry::Point<Number>{lathe->twice(lathe->magnitude(point[1])),
                                                                        lathe->zero, point[0]}
                                              : point);
              }};
        });
  }
  geometry::Box<Number> sides(const Box &box) const {
    geometry::Box<Number> result;
    for (const AxisRange &side : box.sides)
      result.sides[indexOf(*axisOf(side.axis))] = interval(side.range);
    if (!lathe)
      return result;
    const auto &[x, y, z] = result.sides;
    return {{z, radii(x), {}}};
  }
  /// A drill is taken as flat (shapes.h).
  geometry::Tool<Number> tool(const ContractTool &tool, Number none) const {
    const Number radius = number(tool.radius);
    switch (tool.shape) {
    case ToolShape::Ball: return {radius, radius};
    case ToolShape::Bull: return {radius, tool.corner ? number(*tool.corner) : none};
    case ToolShape::Flat:
    case ToolShape::Tip:
    case ToolShape::Drill: return {radius, none};
    }
    return {radius, none};
  }

private:
  /// Absent: the shape is there already.
  std::optional<Shape> acrossAxis(Shape shape) const {
    if (auto *box = std::get_if<geometry::Box<Number>>(&shape)) {
      geometry::Interval<Number> &radii = box->sides[1];
      if (!radii.low)
        return std::nullopt;
      const std::optional<Number> high = radii.high;
      radii.high = lathe->minus(*radii.low);
      radii.low = high ? std::optional(lathe->minus(*high)) : std::nullopt;
      return shape;
    }
    auto *prism = std::get_if<geometry::Prism<Number>>(&shape);
    if (!prism)
      return std::nullopt; // conditions look at the diameter
    for (auto &corner : prism->corners)
      corner[1] = lathe->minus(corner[1]);
    return shape;
  }
  geometry::Interval<Number> interval(const Range &range) const {
    geometry::Interval<Number> result;
    if (range.low)
      result.low = number(*range.low);
    if (range.high)
      result.high = number(*range.high);
    return result;
  }
  geometry::Interval<Number> radii(geometry::Interval<Number> diameters) const {
    for (std::optional<Number> *end : {&diameters.low, &diameters.high})
      if (*end)
        *end = lathe->half(**end);
    return diameters;
  }
  Number on(const std::vector<AxisValue> &centre, Axis axis) const {
    for (const AxisValue &value : centre)
      if (value.axis == letterOf(axis))
        return number(value.value);
    return number(centre.front().value); // each axis is there: the reader of contracts sees to it
  }
};

/// The names of regions, in the order in which they first stand.
inline std::vector<std::string> namesOf(const std::vector<Region> &regions) {
  std::vector<std::string> names;
  for (const Region &region : regions)
    if (std::find(names.begin(), names.end(), region.name) == names.end())
      names.push_back(region.name);
  return names;
}

} // namespace feedhold::prove
