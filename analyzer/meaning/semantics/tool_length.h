// Tool length: what G43 and G44 add along Z, as the offset memory of the control holds it.
#pragma once

#include "meaning/semantics/coordinates.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace feedhold {

/// A number of H for which the control keeps variables; absent: there are none.
inline std::optional<std::uint32_t> lengthOffsetNumber(const Dialect &dialect, double number) {
  const bool isOne = number >= 1 && number <= dialect.behaviour.lengthOffsets.count && number == std::floor(number);
  return isOne ? std::optional(static_cast<std::uint32_t>(number)) : std::nullopt;
}

/// The variables whose sum is the length of an offset number that has them.
inline std::array<std::uint32_t, 2> lengthVariables(const Dialect &dialect, std::uint32_t number) {
  const OffsetMemory &memory = dialect.behaviour.lengthOffsets;
  return {cellOf(dialect, memory.geometry.front() + number - 1), cellOf(dialect, memory.wear.front() + number - 1)};
}

/// One of the variables of lengths, by the number of its cell.
inline bool isOffsetVariable(const Dialect &dialect, const OffsetMemory &memory, std::uint32_t cell) {
  return std::ranges::any_of(std::array{memory.geometry.front(), memory.wear.front()}, [&](std::uint32_t first) {
    const auto isOneFrom = [&](std::uint32_t low) { // only the first numbers may have other names
      return low <= cell && cell - low < memory.count && cellOf(dialect, first + (cell - low)) == cell;
    };
    return isOneFrom(first) || isOneFrom(cellOf(dialect, first));
  });
}
inline bool isLengthVariable(const Dialect &dialect, std::uint32_t cell) {
  return isOffsetVariable(dialect, dialect.behaviour.lengthOffsets, cell);
}

/// The length of an offset number.  Where it is not known which one, or the control keeps none in variables, a run has
/// none: the offsets are the operator's.
template <ValueAlgebra R>
typename R::Value toolLengthOf(StepContext<R> &context, const typename R::Value &offsetNumber) {
  R &interpretation = context.interpretation;
  const auto known = interpretation.constantOf(interpretation.asNumber(offsetNumber));
  if (known == 0.0)
    return context.zero();
  const auto number = known ? lengthOffsetNumber(context.dialect(), *known) : std::nullopt;
  if (!number)
    return interpretation.either(context.zero(), interpretation.anyNumber());
  const auto [geometry, wear] = lengthVariables(context.dialect(), *number);
  return interpretation.add(detail::offsetVariable(context, geometry), detail::offsetVariable(context, wear));
}

/// The length in force, if one is, may be another one.
template <ValueAlgebra R> void forgetLength(StepContext<R> &context) {
  const auto always = context.interpretation.truth(true);
  if (context.certain(context.inForce(ModalKind::Length, {CodeAction::LengthOff}, always)))
    return;
  auto &length = context.state.lengthOffset;
  length = context.interpretation.either(length, context.interpretation.anyNumber());
}

/// G43 or G44 may have been cancelled, as by G49.
template <ValueAlgebra R> void mayCancelLengthCode(StepContext<R> &context, typename R::Truth when) {
  R &interpretation = context.interpretation;
  const auto group = context.modes.groupOf(ModalKind::Length);
  const CodeMask off = group ? context.modes.maskOf(ModalKind::Length, {CodeAction::LengthOff}) : CodeMask{0};
  if (off == 0)
    return;
  auto &code = context.state.codes[*group];
  code = interpretation.selectCode(when, interpretation.code(static_cast<std::uint8_t>(std::countr_zero(off))), code);
}

/// A move of Z to the reference position or in machine coordinates: the length in force ends there, or is in force
/// again behind it (Haas: G28 cancels it; FANUC: its vector is cancelled, and G43 stays).
template <ValueAlgebra R> void mayCancelLength(StepContext<R> &context, typename R::Truth when) {
  R &interpretation = context.interpretation;
  MachineState<R> &state = context.state;
  const auto isOn =
      interpretation.negation(context.inForce(ModalKind::Length, {CodeAction::LengthOff}, interpretation.truth(true)));
  const auto cancels = interpretation.both(interpretation.both(when, isOn), context.maybeNot());
  if (context.behaviour().lengthOffsets.count == 0 || !interpretation.mayBe(cancels))
    return;
  const auto ended = interpretation.select(cancels, state.lengthOffset, context.zero());
  mayCancelLengthCode(context, cancels);
  state.lengthOffset = interpretation.subtract(state.lengthOffset, ended);
  state.lengthChanged = context.either(state.lengthChanged, cancels);
  shiftCoordinate(context, Axis::Z, ended);
}

/// A cell of the memory is written: a parameter decides whether the length in force changes with it (FANUC 5001#6,
/// EVO), or stays until the next H.
template <ValueAlgebra R> void changeLengthOffset(StepContext<R> &context, std::uint32_t cell) {
  if (isLengthVariable(context.dialect(), cell))
    forgetLength(context);
}

} // namespace feedhold
