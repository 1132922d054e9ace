// Coordinates: where the zero point of the work coordinate system lies, and the mappings between what a program writes
// and work coordinates (mirror, scaling, rotation).
//
// What is written is scaled, then turned, then mirrored.  Source: FANUC operator's manual: scaling comes before
// rotation and scales the centre of the rotation, not its angle; a mirror image of one axis of the plane makes a
// rotation turn the other way, so that the whole of the turned figure is mirrored.
#pragma once

#include "meaning/semantics/context.h"

#include <cmath>

namespace feedhold {

/// Machine coordinate of the zero point of the program on an axis: work offsets, G52, G92 and tool length together.
template <ValueAlgebra R> typename R::Value originOf(StepContext<R> &context, Axis axis);

/// The same without tool length: of the work coordinate system.
template <ValueAlgebra R> typename R::Value workOriginOf(StepContext<R> &context, Axis axis);

/// The zero points of all axes, to be given to moveOrigins when they have changed.
template <ValueAlgebra R> std::array<typename R::Value, kAxisCount> originsOf(StepContext<R> &context);
template <ValueAlgebra R>
void moveOrigins(StepContext<R> &context, const std::array<typename R::Value, kAxisCount> &before);

/// The zero point of an axis moves while the machine stands still: the coordinate of the tool becomes greater by
/// `distance`.
template <ValueAlgebra R> void shiftCoordinate(StepContext<R> &context, Axis axis, const typename R::Value &distance);

/// Zero points have moved by distances that are not known.
template <ValueAlgebra R> void havocOrigins(StepContext<R> &context);

/// The words of a cycle that are in force may be others, or none.
template <ValueAlgebra R> void forgetCycle(StepContext<R> &context) {
  auto &[bottom, retract, initial, peck, dwell] = context.state.cycle;
  for (auto *level : {&bottom, &retract, &initial, &peck, &dwell})
    *level = context.interpretation.either(*level, context.interpretation.anything());
}

/// What a block leaves out may be anything, or nothing is kept for it any more (kept_words.h); so in a run.
template <ValueAlgebra R> void forgetKeptWords(StepContext<R> &context) {
  R &interpretation = context.interpretation;
  for (auto *kept : {&context.state.kept.first, &context.state.kept.second})
    if (!context.certain(interpretation.isVacant(*kept)))
      *kept = interpretation.either(interpretation.vacant(), interpretation.anything());
}

/// Nothing is known any more of where the tool is; a run takes it to be where it was.
template <ValueAlgebra R> void havocPosition(StepContext<R> &context);

/// From programmed to work coordinates, and back.
template <ValueAlgebra R>
std::array<typename R::Value, kAxisCount> toWork(StepContext<R> &context,
                                                 std::array<typename R::Value, kAxisCount> programmed);
template <ValueAlgebra R>
std::array<typename R::Value, kAxisCount> toProgrammed(StepContext<R> &context,
                                                       std::array<typename R::Value, kAxisCount> work);

/// What becomes of a distance that is written, axis by axis.
template <ValueAlgebra R>
std::array<typename R::Value, kAxisCount> toWorkDistance(StepContext<R> &context,
                                                         std::array<typename R::Value, kAxisCount> written);
/// A coordinate on an axis that no rotation turns.
template <ValueAlgebra R>
typename R::Value toWorkOn(StepContext<R> &context, Axis axis, const typename R::Value &written);
template <ValueAlgebra R>
typename R::Value toWorkDistanceOn(StepContext<R> &context, Axis axis, const typename R::Value &written);

/// What the mappings make of circles in a plane.
template <typename R> struct CircleMapping {
  typename R::Truth staysCircle; // both axes are scaled alike
  typename R::Truth turnsOver;   // clockwise becomes counterclockwise
  typename R::Value scale;       // of radii, above zero
};
template <ValueAlgebra R> CircleMapping<R> circleMappingOf(StepContext<R> &context, const Plane &plane);

/// The programmed axis words run against the coordinate on this axis.
template <ValueAlgebra R> typename R::Truth isReversed(StepContext<R> &context, Axis axis);

/// A mode is in force in which movements mean something that is not followed: interpolation in polar or cylindrical
/// coordinates, a tilted plane, the compensation of five axes, a cycle that is not modelled.
template <ValueAlgebra R> typename R::Truth otherGeometry(StepContext<R> &context);

/// The plane in force; absent when it can be several.
template <ValueAlgebra R> std::optional<Plane> planeOf(StepContext<R> &context);

inline constexpr std::array kPlanes = {std::pair(CodeAction::PlaneXY, kPlaneXY),
                                       std::pair(CodeAction::PlaneZX, kPlaneZX),
                                       std::pair(CodeAction::PlaneYZ, kPlaneYZ)};
/// A code of their group that is none of the three planes: of axes beside X, Y and Z, on a cylinder, a tilted one.
template <ValueAlgebra R> typename R::Truth inOtherPlane(const StepContext<R> &context);

// ---- implementation -----------------------------------------------------------------------------------------------

namespace detail {

/// No absolute word may have named the axis since the mappings changed.
template <ValueAlgebra R> bool isPending(StepContext<R> &context, Axis axis) {
  R &interpretation = context.interpretation;
  return interpretation.mayBe(
      interpretation.negation(interpretation.isVacant(context.state.transform.pending[indexOf(axis)])));
}
template <ValueAlgebra R> void havocPending(StepContext<R> &context, Axis axis) {
  R &interpretation = context.interpretation;
  auto &pending = context.state.transform.pending[indexOf(axis)];
  pending = interpretation.select(interpretation.isVacant(pending), pending,
                                  interpretation.either(pending, interpretation.anyNumber()));
}

/// That of the P in force.
template <ValueAlgebra R> std::optional<std::uint32_t> additionalOffsetInForce(StepContext<R> &context) {
  const auto number = context.interpretation.constantOf(context.state.word('P'));
  const bool isNumber = number && *number >= 1 && *number <= 0xFFFF && *number == std::floor(*number);
  return isNumber ? additionalWorkOffset(context.dialect(), static_cast<std::uint32_t>(*number)) : std::nullopt;
}

/// The variable of X of the work offset in force; absent when it is not known which one is.
template <ValueAlgebra R> std::optional<std::uint32_t> workOffsetInForce(StepContext<R> &context) {
  const auto group = context.modes.groupOf(ModalKind::WorkOffset);
  if (!group)
    return kFirstWorkOffset + kWorkOffsetStride;
  const auto index = context.interpretation.onlyCode(context.state.codes[*group]);
  if (!index)
    return std::nullopt;
  const auto &codes = context.modes.group(*group).codes;
  if (codes[*index]->action == CodeAction::ExtendedWorkOffset)
    return additionalOffsetInForce(context);
  if (codes[*index]->action != CodeAction::WorkOffset)
    return std::nullopt;
  std::uint32_t before = 0;
  for (std::size_t i = 0; i < *index; ++i)
    before += codes[i]->action == CodeAction::WorkOffset ? 1 : 0;
  return kFirstWorkOffset + kWorkOffsetStride * (before + 1);
}

template <ValueAlgebra R> typename R::Value offsetVariable(StepContext<R> &context, std::uint32_t number) {
  const auto *value = context.state.variables.find(number);
  return context.interpretation.asNumber(value ? *value : context.interpretation.unwritten(context.state, number));
}

template <ValueAlgebra R>
typename R::Value rotated(StepContext<R> &context, typename R::Value x, typename R::Value y, typename R::Value sine,
                          typename R::Value cosine) {
  R &interpretation = context.interpretation;
  return interpretation.subtract(interpretation.multiply(x, cosine), interpretation.multiply(y, sine));
}

/// Turns the coordinates of the rotation's plane (that in force) by `angle` about `centre`.
template <ValueAlgebra R>
void rotate(StepContext<R> &context, std::array<typename R::Value, kAxisCount> &point, const typename R::Value &angle,
            const std::array<typename R::Value, 2> &centre) {
  R &interpretation = context.interpretation;
  if (context.certain(interpretation.compare(Relation::Equal, angle, context.zero())))
    return;
  const std::optional<Plane> plane = planeOf(context);
  if (!plane) {
    for (auto &coordinate : point)
      coordinate = interpretation.anyNumber();
    return;
  }
  const auto x = interpretation.subtract(point[indexOf(plane->first)], centre[0]);
  const auto y = interpretation.subtract(point[indexOf(plane->second)], centre[1]);
  const auto sine = interpretation.function(FunctionKind::Sin, angle);
  const auto cosine = interpretation.function(FunctionKind::Cos, angle);
  point[indexOf(plane->first)] = interpretation.add(centre[0], rotated(context, x, y, sine, cosine));
  point[indexOf(plane->second)] =
      interpretation.add(centre[1], rotated(context, y, x, interpretation.negate(sine), cosine));
}

template <ValueAlgebra R>
typename R::Value mirrored(StepContext<R> &context, std::size_t axis, const typename R::Value &coordinate) {
  R &interpretation = context.interpretation;
  const auto &at = context.state.transform.mirrorAt[axis];
  const auto image = interpretation.subtract(
      interpretation.multiply(interpretation.number(2), interpretation.asNumber(at)), coordinate);
  return interpretation.select(interpretation.isVacant(at), coordinate, image);
}
template <ValueAlgebra R>
typename R::Value mirroredDistance(StepContext<R> &context, std::size_t axis, const typename R::Value &distance) {
  R &interpretation = context.interpretation;
  return interpretation.select(interpretation.isVacant(context.state.transform.mirrorAt[axis]), distance,
                               interpretation.negate(distance));
}

template <ValueAlgebra R>
typename R::Value scaled(StepContext<R> &context, std::size_t axis, const typename R::Value &coordinate) {
  R &interpretation = context.interpretation;
  const auto &centre = context.state.transform.scaleCentre[axis];
  const auto &factor = context.state.transform.scale[axis];
  return interpretation.add(centre, interpretation.multiply(interpretation.subtract(coordinate, centre), factor));
}

template <ValueAlgebra R> typename R::Truth differ(StepContext<R> &context, typename R::Truth a, typename R::Truth b) {
  R &interpretation = context.interpretation;
  return context.either(interpretation.both(a, interpretation.negation(b)),
                        interpretation.both(interpretation.negation(a), b));
}

/// Codes that stay in force and give movements a meaning of their own.
inline CodeMask otherGeometryMask(const ModalGroup &group) {
  CodeMask mask = 0;
  for (std::size_t i = 0; i < group.codes.size(); ++i)
    if (const CodeAction action = group.codes[i]->action;
        action == CodeAction::Unmodelled || action == CodeAction::OtherCycle || action == CodeAction::SideCycle)
      mask |= CodeMask{1} << i;
  return mask;
}

/// From here on, where `when` holds, movements mean something else: kModalGeometry or kLastingGeometry.
template <ValueAlgebra R> void enterOtherGeometry(StepContext<R> &context, int what, typename R::Truth when) {
  R &interpretation = context.interpretation;
  auto &other = context.state.transform.other;
  const auto enters = what == kLastingGeometry ? when : interpretation.both(when, interpretation.isVacant(other));
  other = interpretation.select(enters, interpretation.number(what), other);
  context.state.transformed = context.either(context.state.transformed, when);
}

} // namespace detail

template <ValueAlgebra R> std::optional<Plane> planeOf(StepContext<R> &context) {
  const auto truth = [&](CodeAction action) {
    return context.certain(context.inForce(ModalKind::Plane, {action}, context.interpretation.truth(false)));
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
  return axis == Axis::Z ? context.interpretation.add(origin, context.state.lengthOffset) : origin;
}

template <ValueAlgebra R> typename R::Value workOriginOf(StepContext<R> &context, Axis axis) {
  R &interpretation = context.interpretation;
  const auto number = static_cast<std::uint32_t>(indexOf(axis));
  auto origin = interpretation.add(context.state.shift[indexOf(axis)], context.state.local[indexOf(axis)]);
  const VariableRange *external = findVariable(context.dialect(), kFirstWorkOffset);
  if (external && external->role == VariableRole::WorkOffset)
    origin = interpretation.add(origin, detail::offsetVariable(context, kFirstWorkOffset + number));
  const std::optional<std::uint32_t> first = detail::workOffsetInForce(context);
  return first ? interpretation.add(origin, detail::offsetVariable(context, *first + number))
               : interpretation.anyNumber();
}

template <ValueAlgebra R> std::array<typename R::Value, kAxisCount> originsOf(StepContext<R> &context) {
  std::array<typename R::Value, kAxisCount> origins;
  for (const Axis axis : kAllAxes)
    origins[indexOf(axis)] = originOf(context, axis);
  return origins;
}

template <ValueAlgebra R>
void moveOrigins(StepContext<R> &context, const std::array<typename R::Value, kAxisCount> &before) {
  R &interpretation = context.interpretation;
  for (const Axis axis : kAllAxes) {
    shiftCoordinate(context, axis, interpretation.subtract(before[indexOf(axis)], originOf(context, axis)));
  }
}

template <ValueAlgebra R> void shiftCoordinate(StepContext<R> &context, Axis axis, const typename R::Value &distance) {
  R &interpretation = context.interpretation;
  MachineState<R> &state = context.state;
  const std::size_t i = indexOf(axis);
  state.at(axis) = interpretation.add(state.at(axis), distance);
  if (context.certain(interpretation.compare(Relation::Equal, distance, context.zero())))
    return;
  if (detail::isPending(context, axis))
    detail::havocPending(context, axis);
  // Mitsubishi M700V: the centre of a rotation stays where it is; other manuals do not say.
  const auto stays = context.isOn(&Switches::centreStays);
  const auto keep = [&](typename R::Value &coordinate) {
    const auto isNone = interpretation.isVacant(coordinate);
    if (context.certain(isNone))
      return;
    const auto moved = interpretation.add(interpretation.asNumber(coordinate), distance);
    coordinate = interpretation.select(isNone, coordinate, interpretation.select(stays, moved, coordinate));
  };
  const std::optional<Plane> plane = planeOf(context);
  if (!plane || axis == plane->first || axis == plane->second)
    forgetKeptWords(context);
  if (interpretation.mayBe(state.transformed)) {
    keep(state.transform.scaleCentre[i]);
    keep(state.transform.mirrorAt[i]);
    if (!plane)
      state.transform.centre.fill(interpretation.anyNumber());
    else if (axis == plane->first || axis == plane->second)
      keep(state.transform.centre[axis == plane->first ? 0 : 1]);
  }
  if (context.dialect().machine == MachineKind::Turning)
    forgetCycle(context);
  else if (!plane || axis == plane->normal || axis == Axis::Z)
    for (auto *level : {&state.cycle.bottom, &state.cycle.retract, &state.cycle.initial})
      keep(*level);
}

template <ValueAlgebra R> void havocOrigins(StepContext<R> &context) {
  havocPosition(context);
  for (const Axis axis : kAllAxes)
    shiftCoordinate(context, axis, context.interpretation.either(context.zero(), context.interpretation.anyNumber()));
}

template <ValueAlgebra R> void havocPosition(StepContext<R> &context) {
  if constexpr (requires { context.interpretation.losePosition(); })
    context.interpretation.losePosition();
  for (auto &coordinate : context.state.position)
    coordinate = context.interpretation.either(coordinate, context.interpretation.anyNumber());
  forgetKeptWords(context);
  for (const Axis axis : kAllAxes)
    if (detail::isPending(context, axis))
      detail::havocPending(context, axis);
}

template <ValueAlgebra R>
std::array<typename R::Value, kAxisCount> toWork(StepContext<R> &context,
                                                 std::array<typename R::Value, kAxisCount> point) {
  if (!context.interpretation.mayBe(context.state.transformed))
    return point;
  for (std::size_t axis = 0; axis < kAxisCount; ++axis)
    point[axis] = detail::scaled(context, axis, point[axis]);
  detail::rotate(context, point, context.state.transform.angle, context.state.transform.centre);
  for (std::size_t axis = 0; axis < kAxisCount; ++axis)
    point[axis] = detail::mirrored(context, axis, point[axis]);
  return point;
}

template <ValueAlgebra R>
std::array<typename R::Value, kAxisCount> toProgrammed(StepContext<R> &context,
                                                       std::array<typename R::Value, kAxisCount> point) {
  R &interpretation = context.interpretation;
  if (!interpretation.mayBe(context.state.transformed))
    return point;
  const auto &transform = context.state.transform;
  for (std::size_t axis = 0; axis < kAxisCount; ++axis)
    point[axis] = detail::mirrored(context, axis, point[axis]);
  detail::rotate(context, point, interpretation.negate(transform.angle), transform.centre);
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    const auto &centre = transform.scaleCentre[axis];
    const auto fromCentre = interpretation.subtract(point[axis], centre);
    point[axis] = interpretation.add(centre, interpretation.divide(fromCentre, transform.scale[axis]));
  }
  return point;
}

template <ValueAlgebra R>
std::array<typename R::Value, kAxisCount> toWorkDistance(StepContext<R> &context,
                                                         std::array<typename R::Value, kAxisCount> distance) {
  R &interpretation = context.interpretation;
  if (!interpretation.mayBe(context.state.transformed))
    return distance;
  const auto &transform = context.state.transform;
  for (std::size_t axis = 0; axis < kAxisCount; ++axis)
    distance[axis] = interpretation.multiply(distance[axis], transform.scale[axis]);
  detail::rotate(context, distance, transform.angle, {context.zero(), context.zero()});
  for (std::size_t axis = 0; axis < kAxisCount; ++axis)
    distance[axis] = detail::mirroredDistance(context, axis, distance[axis]);
  return distance;
}

template <ValueAlgebra R>
typename R::Value toWorkOn(StepContext<R> &context, Axis axis, const typename R::Value &written) {
  if (!context.interpretation.mayBe(context.state.transformed))
    return written;
  return detail::mirrored(context, indexOf(axis), detail::scaled(context, indexOf(axis), written));
}

template <ValueAlgebra R>
typename R::Value toWorkDistanceOn(StepContext<R> &context, Axis axis, const typename R::Value &written) {
  if (!context.interpretation.mayBe(context.state.transformed))
    return written;
  const auto &factor = context.state.transform.scale[indexOf(axis)];
  return detail::mirroredDistance(context, indexOf(axis), context.interpretation.multiply(written, factor));
}

template <ValueAlgebra R> typename R::Truth isReversed(StepContext<R> &context, Axis axis) {
  R &interpretation = context.interpretation;
  if (!interpretation.mayBe(context.state.transformed))
    return interpretation.truth(false);
  const auto &transform = context.state.transform;
  const auto isMirrored = interpretation.negation(interpretation.isVacant(transform.mirrorAt[indexOf(axis)]));
  const auto isNegative = interpretation.compare(Relation::Less, transform.scale[indexOf(axis)], context.zero());
  return detail::differ(context, isMirrored, isNegative);
}

template <ValueAlgebra R> CircleMapping<R> circleMappingOf(StepContext<R> &context, const Plane &plane) {
  R &interpretation = context.interpretation;
  if (!interpretation.mayBe(context.state.transformed))
    return {interpretation.truth(true), interpretation.truth(false), interpretation.number(1)};
  const auto size = [&](Axis axis) {
    const auto &factor = context.state.transform.scale[indexOf(axis)];
    return interpretation.select(interpretation.compare(Relation::Less, factor, context.zero()),
                                 interpretation.negate(factor), factor);
  };
  const auto first = size(plane.first);
  return {interpretation.compare(Relation::Equal, first, size(plane.second)),
          detail::differ(context, isReversed(context, plane.first), isReversed(context, plane.second)), first};
}

template <ValueAlgebra R> typename R::Truth inOtherPlane(const StepContext<R> &context) {
  const auto group = context.modes.groupOf(ModalKind::Plane);
  if (!group)
    return context.interpretation.truth(false);
  const auto &codes = context.modes.group(*group).codes;
  CodeMask others = 0;
  for (std::size_t i = 0; i < codes.size(); ++i)
    if (std::ranges::none_of(kPlanes, [&](const auto &plane) { return plane.first == codes[i]->action; }))
      others |= CodeMask{1} << i;
  return context.interpretation.isOneOf(context.state.codes[*group], others);
}

template <ValueAlgebra R> typename R::Truth otherGeometry(StepContext<R> &context) {
  R &interpretation = context.interpretation;
  const auto &other = context.state.transform.other;
  const auto entered =
      interpretation.both(context.state.transformed, interpretation.negation(interpretation.isVacant(other)));
  if (!interpretation.mayBe(entered))
    return interpretation.truth(false);
  auto inForce =
      interpretation.compare(Relation::Equal, interpretation.asNumber(other), interpretation.number(kLastingGeometry));
  for (std::size_t group = 1; group < kModalGroups; ++group)
    if (const CodeMask mask = detail::otherGeometryMask(context.modes.group(group)); mask != 0)
      inForce = context.either(inForce, interpretation.isOneOf(context.state.codes[group], mask));
  return interpretation.both(entered, inForce);
}

} // namespace feedhold
