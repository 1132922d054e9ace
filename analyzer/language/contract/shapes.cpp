// The tool and the shapes of regions: of a lathe in X and Z, with X as a diameter.
#include "language/contract/clauses.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold {

namespace {

constexpr std::string_view kSpace = "XYZ";

std::string_view axesOf(MachineKind machine) { return machine == MachineKind::Turning ? "XZ" : kSpace; }

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

Polygon readPolygon(ClauseReader &reader, MachineKind machine) {
  constexpr std::size_t kFewestCorners = 3;
  const bool isLathe = machine == MachineKind::Turning;
  const std::string_view second = isLathe ? "Z" : "Y";
  const Span begin = reader.ahead();
  Polygon polygon;
  do {
    if (!reader.takeLetter("X"))
      reader.expected(fmt::format("a corner such as `X0 {}0`", second));
    const ExpressionId x = reader.value("X of a corner");
    if (!reader.takeLetter(second))
      reader.expected(fmt::format("{} of the corner", second));
    polygon.corners.push_back({x, reader.value(fmt::format("{} of a corner", second))});
  } while (!reader.failed() && reader.takeSign('/'));
  if (!reader.failed() && polygon.corners.size() < kFewestCorners)
    reader.fail(ContractIssueKind::Malformed, begin, "at least three corners with `/` between them");
  if (!isLathe)
    polygon.height = readAlong(reader, 'Z');
  return polygon;
}

ToolShape readToolShape(ClauseReader &reader, MachineKind machine) {
  if (machine == MachineKind::Turning) {
    if (!reader.take("TIP"))
      reader.expected("`TIP`, the tool of a lathe");
    return ToolShape::Tip;
  }
  if (reader.take("BALL"))
    return ToolShape::Ball;
  if (reader.take("BULL"))
    return ToolShape::Bull;
  if (reader.take("DRILL"))
    return ToolShape::Drill;
  if (!reader.take("FLAT"))
    reader.expected("`FLAT`, `BALL`, `BULL` or `DRILL`");
  return ToolShape::Flat;
}

/// 9 is 0: the point is the centre of the nose.
std::uint8_t readDirection(ClauseReader &reader) {
  constexpr std::uint32_t kMost = 9;
  if (!reader.take("DIRECTION"))
    reader.expected("`DIRECTION` and the number of the tip, such as `DIRECTION 3`");
  const Span span = reader.ahead();
  const std::uint32_t direction = reader.integer("the number of the tip");
  if (direction > kMost)
    reader.fail(ContractIssueKind::Malformed, span, "the number of the tip, 0 to 9");
  return static_cast<std::uint8_t>(direction % kMost);
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

ContractTool readTool(ClauseReader &reader, MachineKind machine, ClauseId clause) {
  ContractTool tool{clause, readToolShape(reader, machine), ExpressionId(0)};
  if (!reader.take("RADIUS"))
    reader.expected("`RADIUS` and its value");
  tool.radius = reader.value("a radius");
  if (tool.shape == ToolShape::Bull) {
    if (!reader.take("CORNER"))
      reader.expected("`CORNER` and its radius");
    tool.corner = reader.value("a radius");
  }
  if (tool.shape == ToolShape::Tip)
    tool.direction = readDirection(reader);
  return tool;
}

Box readBox(ClauseReader &reader, MachineKind machine) {
  const std::string_view axes = axesOf(machine);
  Box box;
  while (const std::optional<char> axis = reader.peekLetter(axes)) {
    if (std::ranges::find(box.sides, *axis, &AxisRange::axis) != box.sides.end()) {
      reader.expected(fmt::format("each axis only once, but {} occurs twice", *axis));
      return box;
    }
    reader.takeLetter(axes);
    box.sides.push_back({*axis, reader.range(fmt::format("the range of {}", *axis))});
  }
  if (box.sides.empty())
    reader.expected(machine == MachineKind::Turning ? "sides such as `X0..200 Z-80..-60`"
                                                    : "sides such as `X-10..10 Y0..5 Z-3..0`");
  return box;
}

decltype(Region::shape) readShape(ClauseReader &reader, MachineKind machine) {
  const bool isLathe = machine == MachineKind::Turning;
  if (reader.take("BOX"))
    return readBox(reader, machine);
  if (!isLathe && reader.take("CYLINDER"))
    return readCylinder(reader);
  if (!isLathe && reader.take("SPHERE"))
    return readSphere(reader);
  if (reader.take("POLYGON"))
    return readPolygon(reader, machine);
  if (reader.take("WHERE"))
    return Where{reader.condition(isLathe ? findPointOfLathe : findPoint)};
  reader.expected(isLathe ? "`BOX`, `POLYGON` or `WHERE`" : "`BOX`, `CYLINDER`, `SPHERE`, `POLYGON` or `WHERE`");
  return Box{};
}

} // namespace feedhold
