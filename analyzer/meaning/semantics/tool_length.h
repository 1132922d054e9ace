// Tool length: what G43 and G44 add along Z, as the offset memory of the control holds it.
#pragma once

#include "meaning/semantics/coordinates.h"

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

/// A cell of the memory is written: a parameter decides whether the length in force changes with it (FANUC 5001#6,
/// EVO), or stays until the next H.
template <ValueAlgebra R> void changeLengthOffset(StepContext<R> &context, std::uint32_t cell) {
  const OffsetMemory &memory = context.behaviour().lengthOffsets;
  for (const std::uint32_t first : {memory.geometry.front(), memory.wear.front()})
    if (const std::uint32_t low = cellOf(context.dialect(), first); low <= cell && cell < low + memory.count)
      forgetLength(context);
}

} // namespace feedhold
