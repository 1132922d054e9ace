// The shapes of regions.
#include "language/contract/clauses.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold {

namespace {

constexpr std::string_view kSpace = "XYZ";

/// `AT X30 Y0`: each of these axes once.
std::vector<AxisValue> readCentre(ClauseReader &reader, std::string_view axes) {
  if (!reader.take("AT")) {
    reader.expected("`AT` and the centre");
    return {};
  }
  const Span begin = reader.ahead();
  std::vector<AxisValue> centre = readAxisValues(reader, axes);
  for (const char axis : axes)
    if (!reader.failed() && std::ranges::find(centre, axis, &AxisValue::axis) == centre.end())
      reader.fail(ContractIssueKind::Malformed, begin, fmt::format("{} of the centre", axis));
  return centre;
}

ExpressionId readRadius(ClauseReader &reader) {
  if (!reader.take("RADIUS"))
    reader.expected("`RADIUS` and its value");
  return reader.value("a radius");
}

Range readAlong(ClauseReader &reader, char axis) {
  if (reader.atEnd())
    return {};
  if (!reader.takeLetter(std::string_view(&axis, 1)))
    reader.expected(fmt::format("the range of {}, such as `{}-20..40`", axis, axis));
  return reader.range("the range");
}

Cylinder readCylinder(ClauseReader &reader) {
  Cylinder cylinder{'Z', {}, ExpressionId(0), {}};
  if (reader.take("AXIS")) {
    const std::optional<char> axis = reader.takeLetter(kSpace);
    if (!axis)
      reader.expected("X, Y or Z");
    cylinder.axis = axis.value_or('Z');
  }
  std::string others(kSpace);
  std::erase(others, cylinder.axis);
  cylinder.centre = readCentre(reader, others);
  cylinder.radius = readRadius(reader);
  cylinder.along = readAlong(reader, cylinder.axis);
  return cylinder;
}

Sphere readSphere(ClauseReader &reader) {
  std::vector<AxisValue> centre = readCentre(reader, kSpace);
  return {std::move(centre), readRadius(reader)};
}

Polygon readPolygon(ClauseReader &reader) {
  constexpr std::size_t kFewestCorners = 3;
  const Span begin = reader.ahead();
  Polygon polygon;
  do {
    if (!reader.takeLetter("X"))
      reader.expected("a corner such as `X0 Y0`");
    const ExpressionId x = reader.value("X of a corner");
    if (!reader.takeLetter("Y"))
      reader.expected("Y of the corner");
    polygon.corners.push_back({x, reader.value("Y of a corner")});
  } while (!reader.failed() && reader.takeSign('/'));
  if (!reader.failed() && polygon.corners.size() < kFewestCorners)
    reader.fail(ContractIssueKind::Malformed, begin, "at least three corners with `/` between them");
  polygon.height = readAlong(reader, 'Z');
  return polygon;
}

} // namespace

std::vector<AxisValue> readAxisValues(ClauseReader &reader, std::string_view axes) {
  std::vector<AxisValue> values;
  while (const std::optional<char> axis = reader.peekLetter(axes)) {
    if (std::ranges::find(values, *axis, &AxisValue::axis) != values.end()) {
      reader.expected(fmt::format("each axis only once, but {} occurs twice", *axis));
      return values;
    }
    reader.takeLetter(axes);
    values.push_back({*axis, reader.value(fmt::format("a value of {}", *axis))});
  }
  return values;
}

Box readBox(ClauseReader &reader) {
  Box box;
  while (const std::optional<char> axis = reader.peekLetter(kSpace)) {
    if (std::ranges::find(box.sides, *axis, &AxisRange::axis) != box.sides.end()) {
      reader.expected(fmt::format("each axis only once, but {} occurs twice", *axis));
      return box;
    }
    reader.takeLetter(kSpace);
    box.sides.push_back({*axis, reader.range(fmt::format("the range of {}", *axis))});
  }
  if (box.sides.empty())
    reader.expected("sides such as `X-10..10 Y0..5 Z-3..0`");
  return box;
}

decltype(Region::shape) readShape(ClauseReader &reader) {
  if (reader.take("BOX"))
    return readBox(reader);
  if (reader.take("CYLINDER"))
    return readCylinder(reader);
  if (reader.take("SPHERE"))
    return readSphere(reader);
  if (reader.take("POLYGON"))
    return readPolygon(reader);
  if (reader.take("WHERE"))
    return Where{reader.condition(findPoint)};
  reader.expected("`BOX`, `CYLINDER`, `SPHERE`, `POLYGON` or `WHERE`");
  return Box{};
}

} // namespace feedhold
