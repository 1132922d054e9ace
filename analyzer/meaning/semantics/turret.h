// Turret: the tool offsets of a lathe.
//
// A T word (T0102: tool 1 with offset 2) makes coordinates those of the tip of its tool, as G43 does on a machining
// centre, and T0100 takes that away.  The offsets are the operator's: a run takes them to be 0, so that the turret and
// each tip are at the same place; all else allows for any.
#pragma once

#include "meaning/semantics/coordinates.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace feedhold {

/// An axis that turns the part, or moves it or the tool in a way that regions do not describe.  C of a lathe turns the
/// part as its spindle does.
inline bool isBesideRegions(const Dialect &dialect, Axis axis) {
  if (dialect.machine == MachineKind::Turning)
    return axis != Axis::X && axis != Axis::Z && axis != Axis::C;
  return indexOf(axis) > indexOf(Axis::Z);
}

template <ValueAlgebra R> bool hasTurret(const StepContext<R> &context) {
  return context.dialect().machine == MachineKind::Turning;
}

/// How far the tip of the tool in force lies from the turret, along an axis.
template <ValueAlgebra R> typename R::Value tipDistance(StepContext<R> &context, Axis axis) {
  const bool isAlong = hasTurret(context) && (axis == Axis::X || axis == Axis::Y || axis == Axis::Z);
  return isAlong ? context.interpretation.either(context.zero(), context.interpretation.anyNumber()) : context.zero();
}

/// Machine coordinate of the zero point for the turret, to which reference positions and G53 bring it.
template <ValueAlgebra R> typename R::Value machineOriginOf(StepContext<R> &context, Axis axis) {
  const auto origin = originOf(context, axis);
  return hasTurret(context) ? context.interpretation.add(origin, tipDistance(context, axis)) : origin;
}

/// The number of the offset that a T word names: its last two digits.
inline double tipNumber(double toolWord) {
  constexpr double kOffsets = 100;
  return std::fmod(toolWord, kOffsets);
}

/// The offset of a T word is in force: its number is not 0.
template <ValueAlgebra R> typename R::Truth tipInForce(StepContext<R> &context) {
  R &interpretation = context.interpretation;
  const auto word = interpretation.constantOf(interpretation.asNumber(context.state.word('T')));
  return interpretation.truth(word && tipNumber(*word) != 0);
}

/// Coordinates are those of the tip, if they were so at the start: no T word has come since, or one with an offset.
template <ValueAlgebra R> typename R::Truth tipIsKnown(StepContext<R> &context) {
  return context.either(context.interpretation.negation(context.state.lengthChanged), tipInForce(context));
}

/// Another offset, or another value of it: the zero point moves while the machine stands still.
template <ValueAlgebra R> void changeTip(StepContext<R> &context, typename R::Truth when) {
  R &interpretation = context.interpretation;
  if (!hasTurret(context) || !interpretation.mayBe(when))
    return;
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
    shiftCoordinate(context, axis, interpretation.select(when, tipDistance(context, axis), context.zero()));
}

/// One of these variables may be a tool offset of a lathe: of its tip, or of its nose.
inline bool mayBeTipOffset(std::uint32_t low, std::uint32_t high) {
  constexpr std::array<std::array<std::uint32_t, 2>, 2> kOffsets = {{{2001, 2999}, {10001, 19999}}};
  return std::ranges::any_of(kOffsets, [&](const auto &each) { return low <= each[1] && each[0] <= high; });
}

/// A variable is written that may be an offset in force.
template <ValueAlgebra R>
void changeTipOffset(StepContext<R> &context, const VariableRange &range, std::uint32_t cell) {
  if (range.role == VariableRole::Stored && mayBeTipOffset(cell, cell))
    changeTip(context, context.interpretation.truth(true));
}

} // namespace feedhold
