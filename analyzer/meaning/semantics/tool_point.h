// ToolPoint: where the coordinates of a movement lie in the space of the program's start, and whether they are those of
// the tool at all.
//
// With tool length in force (G43) coordinates are those of the tip: its offset is taken to be the tool's length.  So are
// they where the length has not been changed since the start.  Where the program itself takes it away, Z is not known.
#pragma once

#include "meaning/semantics/coordinates.h"

namespace feedhold {

template <ValueAlgebra R> struct ToolPoint {
  /// X, Y, Z: how far the zero point lies from that of the start, by work offsets, G52 and G92.
  std::array<typename R::Value, 3> zero;
  typename R::Truth withoutCompensation; // of the cutter radius (G40)
  typename R::Truth lengthKnown;
  typename R::Truth sameUnits; // as at the start
};

/// Of the movements of the present block; `entry`: the state at the start.
template <ValueAlgebra R> ToolPoint<R> toolPointOf(StepContext<R> &context, MachineState<R> &entry);

// ---- implementation -----------------------------------------------------------------------------------------------

namespace detail {

template <ValueAlgebra R> bool isAsAtEntry(StepContext<R> &context, const MachineState<R> &entry, ModalKind kind) {
  const auto group = context.modes.groupOf(kind);
  return !group || context.state.codes[*group] == entry.codes[*group];
}

/// An offset has been written, or may have been, and it is not known of which system that in force is.
template <ValueAlgebra R> bool offsetIsOpen(StepContext<R> &context) {
  if (workOffsetInForce(context))
    return false;
  const auto &rows = context.dialect().variables;
  return std::any_of(rows.begin(), rows.end(), [&](const VariableRange &row) {
    if (row.role != VariableRole::WorkOffset)
      return false;
    const auto &written = context.state.variables.entries();
    const auto &forgotten = context.state.forgotten;
    return std::any_of(written.begin(), written.end(),
                       [&](const auto &each) { return row.first <= each.first && each.first <= row.last; }) ||
           std::any_of(forgotten.begin(), forgotten.end(),
                       [&](const auto &range) { return range.first <= row.last && row.first <= range.second; });
  });
}

template <ValueAlgebra R>
std::array<typename R::Value, 3> zeroShift(StepContext<R> &context, MachineState<R> &entry) {
  R &reading = context.reading;
  StepContext<R> atEntry{reading, entry, context.programs, context.file, context.modes, context.block};
  const bool sameSystem = isAsAtEntry(context, entry, ModalKind::WorkOffset);
  const bool unknownSystem = !workOffsetInForce(context);
  // `G54.1 P2` stays the same code when another P comes.
  const auto additional = [&] {
    const auto group = context.modes.groupOf(ModalKind::WorkOffset);
    return group && reading.onlyCode(context.state.codes[*group]) ? reading.anyNumber() : context.zero();
  };
  std::array<typename R::Value, 3> shift;
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
    auto &distance = shift[indexOf(axis)];
    const std::size_t i = indexOf(axis);
    if (unknownSystem && sameSystem && !offsetIsOpen(context))
      distance = reading.add(reading.subtract(reading.add(context.state.shift[i], context.state.local[i]),
                                              reading.add(entry.shift[i], entry.local[i])),
                             additional());
    else
      distance = reading.subtract(workOriginOf(context, axis), workOriginOf(atEntry, axis));
  }
  return shift;
}

} // namespace detail

template <ValueAlgebra R> ToolPoint<R> toolPointOf(StepContext<R> &context, MachineState<R> &entry) {
  R &reading = context.reading;
  const auto always = reading.truth(true);
  const auto orAsAtEntry = [&](ModalKind kind, std::initializer_list<CodeAction> actions) {
    return detail::isAsAtEntry(context, entry, kind) ? always : context.inForce(kind, actions, always);
  };
  return {detail::zeroShift(context, entry),
          context.inForce(ModalKind::Compensation, {CodeAction::CompensationOff}, always),
          orAsAtEntry(ModalKind::Length, {CodeAction::LengthPlus, CodeAction::LengthMinus, CodeAction::LengthGiven}),
          orAsAtEntry(ModalKind::Units, {})};
}

} // namespace feedhold
