// Coordinates: where the zero point of the work coordinate system lies, and the mappings between what a program writes
// and work coordinates (mirror, scaling, rotation).
#pragma once

#include "meaning/semantics/context.h"

namespace feedhold {

/// #5201 external offset, #5221 G54, #5241 G55 ..: one variable for each axis.
inline constexpr std::uint32_t kFirstWorkOffset = 5201;
inline constexpr std::uint32_t kWorkOffsetStride = 20;

/// Machine coordinate of the zero point of the program on an axis: work offsets, G52, G92 and tool length together.
template <ValueAlgebra R> typename R::Value originOf(StepContext<R> &context, Axis axis);

/// The same without tool length: of the work coordinate system.
template <ValueAlgebra R> typename R::Value workOriginOf(StepContext<R> &context, Axis axis);

/// The zero points of all axes, to be given to moveOrigins when they have changed.
template <ValueAlgebra R> std::array<typename R::Value, kAxisCount> originsOf(StepContext<R> &context);
template <ValueAlgebra R>
void moveOrigins(StepContext<R> &context, const std::array<typename R::Value, kAxisCount> &before);

/// Nothing is known any more of where the tool is.
template <ValueAlgebra R> void forgetPosition(StepContext<R> &context);

/// From programmed to work coordinates, and back.
template <ValueAlgebra R>
std::array<typename R::Value, kAxisCount> toWork(StepContext<R> &context,
                                                 std::array<typename R::Value, kAxisCount> programmed);
template <ValueAlgebra R>
std::array<typename R::Value, kAxisCount> toProgrammed(StepContext<R> &context,
                                                       std::array<typename R::Value, kAxisCount> work);

/// The plane in force; absent when it can be several.
template <ValueAlgebra R> std::optional<Plane> planeOf(StepContext<R> &context);

// ---- implementation -----------------------------------------------------------------------------------------------

namespace detail {

/// How many work offset systems lie before the one in force: 0 for G54; absent when it is not one of them.
template <ValueAlgebra R> std::optional<std::uint32_t> workOffsetInForce(StepContext<R> &context) {
  const auto group = context.modes.groupOf(ModalKind::WorkOffset);
  if (!group)
    return 0;
  const auto index = context.reading.onlyCode(context.state.codes[*group]);
  if (!index)
    return std::nullopt;
  const auto &codes = context.modes.group(*group).codes;
  if (codes[*index]->action != CodeAction::WorkOffset)
    return std::nullopt;
  std::uint32_t before = 0;
  for (std::size_t i = 0; i < *index; ++i)
    before += codes[i]->action == CodeAction::WorkOffset ? 1 : 0;
  return before;
}

template <ValueAlgebra R> typename R::Value offsetVariable(StepContext<R> &context, std::uint32_t number) {
  const auto *value = context.state.variables.find(number);
  return context.reading.asNumber(value ? *value : context.reading.unwritten(context.state, number));
}

template <ValueAlgebra R> typename R::Value rotated(StepContext<R> &context, typename R::Value x, typename R::Value y,
                                                    typename R::Value sine, typename R::Value cosine) {
  R &reading = context.reading;
  return reading.subtract(reading.multiply(x, cosine), reading.multiply(y, sine));
}

/// Turns the coordinates of the rotation's plane (that in force) by `angle`.
template <ValueAlgebra R>
void rotate(StepContext<R> &context, std::array<typename R::Value, kAxisCount> &point, const typename R::Value &angle) {
  R &reading = context.reading;
  const std::optional<Plane> plane = planeOf(context);
  if (!plane) {
    for (auto &coordinate : point)
      coordinate = reading.anyNumber();
    return;
  }
  const auto &centre = context.state.transform.centre;
  const auto x = reading.subtract(point[indexOf(plane->first)], centre[0]);
  const auto y = reading.subtract(point[indexOf(plane->second)], centre[1]);
  const auto sine = reading.function(FunctionKind::Sin, angle);
  const auto cosine = reading.function(FunctionKind::Cos, angle);
  point[indexOf(plane->first)] = reading.add(centre[0], rotated(context, x, y, sine, cosine));
  point[indexOf(plane->second)] = reading.add(centre[1], rotated(context, y, x, reading.negate(sine), cosine));
}

template <ValueAlgebra R>
typename R::Value mirrored(StepContext<R> &context, std::size_t axis, const typename R::Value &coordinate) {
  R &reading = context.reading;
  const auto &at = context.state.transform.mirrorAt[axis];
  const auto image = reading.subtract(reading.multiply(reading.number(2), reading.asNumber(at)), coordinate);
  return reading.select(reading.isVacant(at), coordinate, image);
}

} // namespace detail

template <ValueAlgebra R> std::optional<Plane> planeOf(StepContext<R> &context) {
  const auto truth = [&](CodeAction action) {
    return context.certain(context.inForce(ModalKind::Plane, {action}, context.reading.truth(false)));
  };
  if (truth(CodeAction::PlaneXY))
    return kPlaneXY;
  if (truth(CodeAction::PlaneZX))
    return kPlaneZX;
  if (truth(CodeAction::PlaneYZ))
    return kPlaneYZ;
  return std::nullopt;
}

template <ValueAlgebra R> typename R::Value originOf(StepContext<R> &context, Axis axis) {
  const auto origin = workOriginOf(context, axis);
  return axis == Axis::Z ? context.reading.add(origin, context.state.lengthOffset) : origin;
}

template <ValueAlgebra R> typename R::Value workOriginOf(StepContext<R> &context, Axis axis) {
  R &reading = context.reading;
  const auto number = static_cast<std::uint32_t>(indexOf(axis));
  auto origin = reading.add(context.state.shift[indexOf(axis)], context.state.local[indexOf(axis)]);
  const VariableRange *external = findVariable(context.dialect(), kFirstWorkOffset);
  if (external && external->role == VariableRole::WorkOffset)
    origin = reading.add(origin, detail::offsetVariable(context, kFirstWorkOffset + number));
  const std::optional<std::uint32_t> system = detail::workOffsetInForce(context);
  if (!system)
    return reading.anyNumber();
  return reading.add(
      origin, detail::offsetVariable(context, kFirstWorkOffset + kWorkOffsetStride * (*system + 1) + number));
}

template <ValueAlgebra R> std::array<typename R::Value, kAxisCount> originsOf(StepContext<R> &context) {
  std::array<typename R::Value, kAxisCount> origins;
  for (const Axis axis : kAllAxes)
    origins[indexOf(axis)] = originOf(context, axis);
  return origins;
}

template <ValueAlgebra R>
void moveOrigins(StepContext<R> &context, const std::array<typename R::Value, kAxisCount> &before) {
  R &reading = context.reading;
  for (const Axis axis : kAllAxes) {
    auto &coordinate = context.state.at(axis);
    coordinate = reading.add(coordinate, reading.subtract(before[indexOf(axis)], originOf(context, axis)));
  }
}

template <ValueAlgebra R> void forgetPosition(StepContext<R> &context) {
  for (auto &coordinate : context.state.position)
    coordinate = context.reading.anyNumber();
}

template <ValueAlgebra R>
std::array<typename R::Value, kAxisCount> toWork(StepContext<R> &context,
                                                 std::array<typename R::Value, kAxisCount> point) {
  R &reading = context.reading;
  if (!reading.mayBe(context.state.transformed))
    return point;
  const auto &transform = context.state.transform;
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    const auto &centre = transform.scaleCentre[axis];
    const auto scaled =
        reading.add(centre, reading.multiply(reading.subtract(point[axis], centre), transform.scale[axis]));
    point[axis] = detail::mirrored(context, axis, scaled);
  }
  detail::rotate(context, point, transform.angle);
  return point;
}

template <ValueAlgebra R>
std::array<typename R::Value, kAxisCount> toProgrammed(StepContext<R> &context,
                                                       std::array<typename R::Value, kAxisCount> point) {
  R &reading = context.reading;
  if (!reading.mayBe(context.state.transformed))
    return point;
  const auto &transform = context.state.transform;
  detail::rotate(context, point, reading.negate(transform.angle));
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    const auto &centre = transform.scaleCentre[axis];
    const auto straight = reading.subtract(detail::mirrored(context, axis, point[axis]), centre);
    point[axis] = reading.add(centre, reading.divide(straight, transform.scale[axis]));
  }
  return point;
}

} // namespace feedhold
