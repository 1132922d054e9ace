// ToolPoint: where the coordinates of a movement lie in the space of the program's start, and whether they are those of
// the tool at all.
//
// With tool length in force (G43) coordinates are those of the tip: its offset is taken to be the tool's length.  So
// are they where the program has not changed the length.  Where it takes away what it has set itself, Z is not known:
// the codes are then those of the start, and the tip is not where it was.
#pragma once

#include "meaning/semantics/turret.h"

namespace feedhold {

template <ValueAlgebra R> struct ToolPoint {
  /// X, Y, Z: how far the zero point lies from that of the start, by work offsets, G52 and G92.
  std::array<typename R::Value, 3> zero;
  /// X, Y, Z: where the zero point lies in machine coordinates, tool length included.
  std::array<typename R::Value, 3> machineZero;
  typename R::Truth compensationOff;     // of the cutter radius (G40)
  typename R::Truth withoutCompensation; // nor does a cycle take an offset itself
  typename R::Truth lengthKnown;         // coordinates are those of the tip, if they were so at the start
  typename R::Truth withLength;          // that of the tool is in force
  typename R::Truth lengthSubtracted;    // by G44
  typename R::Truth sameUnits;           // as at the start
  typename R::Truth sameFeedMode;        // F means the same
  typename R::Truth sameSpindleMode;     // S means the same
  typename R::Truth sameSide;            // no other axis but those of `fixed` has turned or moved the part, or the tool
};

/// Of the movements of the present block; `entry`: the state at the start; `fixed`: those of `@FIXED`.
template <ValueAlgebra R>
ToolPoint<R> toolPointOf(StepContext<R> &context, MachineState<R> &entry, const AxisSet &fixed = {});

// ---- implementation -----------------------------------------------------------------------------------------------

namespace detail {

template <ValueAlgebra R> bool isAsAtEntry(StepContext<R> &context, const MachineState<R> &entry, ModalKind kind) {
  const auto group = context.modes.groupOf(kind);
  return !group || context.state.codes[*group] == entry.codes[*group];
}

/// The same work offset as at the start, whichever that is: P chooses among those of `G54.1`.
template <ValueAlgebra R> bool hasSystemOfEntry(StepContext<R> &context, const MachineState<R> &entry) {
  R &interpretation = context.interpretation;
  const auto &now = context.state.word('P'), &then = entry.word('P');
  const auto areVacant = interpretation.both(interpretation.isVacant(now), interpretation.isVacant(then));
  const auto areNumbers = interpretation.both(interpretation.negation(interpretation.isVacant(now)),
                                              interpretation.negation(interpretation.isVacant(then)));
  const auto areEqual = interpretation.both(
      areNumbers, interpretation.compare(Relation::Equal, interpretation.asNumber(now), interpretation.asNumber(then)));
  return isAsAtEntry(context, entry, ModalKind::WorkOffset) && context.certain(context.either(areVacant, areEqual));
}

/// An offset has been written, or may have been, and it is not known of which system that in force is.
template <ValueAlgebra R> bool offsetIsOpen(StepContext<R> &context) {
  if (workOffsetInForce(context))
    return false;
  const auto &rows = context.dialect().variables;
  return std::any_of(rows.begin(), rows.end(), [&](const VariableRange &row) {
    if (row.role != VariableRole::WorkOffset && row.role != VariableRole::AdditionalWorkOffset)
      return false;
    const auto &written = context.state.variables.entries();
    const auto &havocked = context.state.havocked;
    return std::any_of(written.begin(), written.end(),
                       [&](const auto &each) { return row.first <= each.first && each.first <= row.last; }) ||
           std::any_of(havocked.begin(), havocked.end(),
                       [&](const auto &range) { return range.first <= row.last && row.first <= range.second; });
  });
}

/// How far the zero point of an axis lies from that of the start.
template <ValueAlgebra R> typename R::Value zeroShift(StepContext<R> &context, MachineState<R> &entry, Axis axis) {
  R &interpretation = context.interpretation;
  StepContext<R> atEntry{interpretation, entry, context.programs, context.file, context.modes, context.block};
  const std::size_t i = indexOf(axis);
  if (!workOffsetInForce(context) && hasSystemOfEntry(context, entry) && !offsetIsOpen(context))
    return interpretation.subtract(interpretation.add(context.state.shift[i], context.state.local[i]),
                                   interpretation.add(entry.shift[i], entry.local[i]));
  return interpretation.subtract(workOriginOf(context, axis), workOriginOf(atEntry, axis));
}

/// The length of a tool is in force; G43 H0 takes it away as G49 does.  On a lathe, the offset of a T word.
template <ValueAlgebra R> typename R::Truth withLength(StepContext<R> &context) {
  R &interpretation = context.interpretation;
  if (hasTurret(context))
    return tipInForce(context);
  const auto byNumber =
      context.inForce(ModalKind::Length, {CodeAction::LengthPlus, CodeAction::LengthMinus}, interpretation.truth(true));
  const auto &number = context.state.word('H');
  const auto isNone =
      interpretation.both(interpretation.negation(interpretation.isVacant(number)),
                          interpretation.compare(Relation::Equal, interpretation.asNumber(number), context.zero()));
  return context.either(context.inForce(ModalKind::Length, {CodeAction::LengthGiven}, interpretation.truth(true)),
                        interpretation.both(byNumber, interpretation.negation(isNone)));
}

/// The block is a cycle that takes the offset of D itself.
template <ValueAlgebra R> bool isPocket(const StepContext<R> &context) {
  return std::ranges::any_of(context.tree().wordsOf(context.block), [&](const Word &word) {
    const Code *code = word.address() == 'G' ? codeOf(word, context.dialect()) : nullptr;
    return code && isCirclePocket(code->action);
  });
}

/// The axes that regions do not describe stand where they stood at the start, but for those of `fixed`.
template <ValueAlgebra R>
typename R::Truth isSameSide(StepContext<R> &context, MachineState<R> &entry, const AxisSet &fixed) {
  R &interpretation = context.interpretation;
  auto same = interpretation.truth(true);
  for (const Axis axis : kAllAxes) {
    const auto &turned = context.state.axisMoved[indexOf(axis)];
    if (fixed[indexOf(axis)] || !isBesideRegions(context.dialect(), axis) || !interpretation.mayBe(turned))
      continue;
    const auto now = interpretation.add(context.state.at(axis), zeroShift(context, entry, axis));
    const auto isBack = interpretation.compare(Relation::Equal, now, entry.at(axis));
    same = interpretation.both(same, context.either(interpretation.negation(turned), isBack));
  }
  return same;
}

} // namespace detail

template <ValueAlgebra R>
ToolPoint<R> toolPointOf(StepContext<R> &context, MachineState<R> &entry, const AxisSet &fixed) {
  R &interpretation = context.interpretation;
  const auto always = interpretation.truth(true);
  const auto orAsAtEntry = [&](ModalKind kind, std::initializer_list<CodeAction> actions) {
    return detail::isAsAtEntry(context, entry, kind) ? always : context.inForce(kind, actions, always);
  };
  const auto compensationOff = context.inForce(ModalKind::Compensation, {CodeAction::CompensationOff}, always);
  const auto withLength = detail::withLength(context);
  const auto shift = [&](Axis axis) { return detail::zeroShift(context, entry, axis); };
  return {{shift(Axis::X), shift(Axis::Y), shift(Axis::Z)},
          {machineOriginOf(context, Axis::X), machineOriginOf(context, Axis::Y), machineOriginOf(context, Axis::Z)},
          compensationOff,
          interpretation.both(compensationOff, interpretation.truth(!detail::isPocket(context))),
          context.either(interpretation.negation(context.state.lengthChanged), withLength),
          withLength,
          context.inForce(ModalKind::Length, {CodeAction::LengthMinus}, interpretation.truth(false)),
          orAsAtEntry(ModalKind::Units, {}),
          orAsAtEntry(ModalKind::FeedMode, {}),
          orAsAtEntry(ModalKind::Spindle, {}),
          detail::isSameSide(context, entry, fixed)};
}

} // namespace feedhold
