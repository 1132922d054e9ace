// Reading and writing variables, system variables included.
#pragma once

#include "meaning/semantics/predefined_names.h"
#include "meaning/semantics/tool_length.h"
#include "meaning/semantics/turret.h"

#include <cmath>

namespace feedhold {

/// The value of variable `number` (not yet asked whether it is vacant).
template <ValueAlgebra R> typename R::Value readVariable(StepContext<R> &context, std::uint32_t number, Span place);
template <ValueAlgebra R>
void writeVariable(StepContext<R> &context, std::uint32_t number, typename R::Value value, Span place);

/// The variable that an index value names: rounded to the nearest; absent when it is not one constant.
template <ValueAlgebra R>
std::optional<std::uint32_t> variableAt(StepContext<R> &context, const typename R::Value &index, Span place) {
  R &interpretation = context.interpretation;
  const auto number = interpretation.asNumber(index);
  interpretation.alarm(interpretation.compare(Relation::Less, number, interpretation.number(-0.5)),
                       {AlarmKind::VariableNotAvailable, place});
  interpretation.alarm(interpretation.compare(Relation::Greater, number, interpretation.number(1e9)),
                       {AlarmKind::VariableNotAvailable, place});
  const std::optional<double> constant = interpretation.constantOf(number);
  if (!constant || *constant < -0.5 || *constant > 1e9)
    return std::nullopt;
  return static_cast<std::uint32_t>(std::floor(*constant + 0.5));
}

namespace detail {

/// The letter of the word that a modal-word variable holds (the number of #4101..#4130 less 4100); absent for M, N, O
/// and the like, which are not followed.
constexpr std::optional<char> letterOfModalWord(std::uint32_t offset) {
  switch (offset) {
  case 2: return 'B';
  case 7: return 'D';
  case 9: return 'F';
  case 11: return 'H';
  case 19: return 'S';
  case 20: return 'T';
  default: return std::nullopt;
  }
}

template <ValueAlgebra R> typename R::Value storedValue(StepContext<R> &context, std::uint32_t number) {
  const auto *value = context.state.variables.find(number);
  return value ? *value : context.interpretation.unwritten(context.state, number);
}

/// The position of the axis in the coordinates in force, as a program reads it.
template <ValueAlgebra R>
typename R::Value presentPosition(StepContext<R> &context, Axis axis, std::uint32_t variable) {
  R &interpretation = context.interpretation;
  const auto compensates = interpretation.negation(
      context.inForce(ModalKind::Compensation, {CodeAction::CompensationOff}, interpretation.truth(true)));
  if (context.behaviour().positionIsOfCutter && interpretation.mayBe(compensates))
    return interpretation.select(compensates, interpretation.notFollowed(variable), context.state.at(axis));
  if constexpr (requires { interpretation.readPosition(axis); })
    interpretation.readPosition(axis);
  return context.state.at(axis);
}

template <ValueAlgebra R>
typename R::Value machinePosition(StepContext<R> &context, Axis axis, std::uint32_t variable) {
  const auto here = presentPosition(context, axis, variable);
  return context.interpretation.add(here, machineOriginOf(context, axis));
}

template <ValueAlgebra R>
typename R::Value readPosition(StepContext<R> &context, const VariableRange &range, std::uint32_t number) {
  const std::uint32_t axis = number - range.first;
  if (axis >= kAxisCount)
    return context.interpretation.anyNumber();
  return range.role == VariableRole::MachinePosition ? machinePosition(context, kAllAxes[axis], number)
                                                     : presentPosition(context, kAllAxes[axis], number);
}

/// A name that shows what another variable holds has no cell of its own.
template <ValueAlgebra R> typename R::Value readPredefined(StepContext<R> &context, const PredefinedName &name) {
  R &interpretation = context.interpretation;
  const std::uint32_t number = name.row.first;
  const Code *code = modalCode(context, name);
  switch (name.source) {
  case NameSource::MachinePosition: return machinePosition(context, kAllAxes[name.detail], number);
  case NameSource::CodeInForce:
    if (code)
      return interpretation.select(isCodeInForce(context, *code), interpretation.number(1), context.zero());
    break;
  case NameSource::CodeTenths:
  case NameSource::CodeWhole:
    if (code)
      return numberInForce(context, name, *code);
    break;
  case NameSource::Kept: return withinRange(context, name.range, interpretation.asNumber(storedValue(context, number)));
  case NameSource::Variable:
  case NameSource::NotFollowed: break;
  }
  return withinRange(context, name.range, interpretation.notFollowed(number));
}

/// The number whose bits are the variables of the row, where all of them are known.
template <ValueAlgebra R> typename R::Value readBits(StepContext<R> &context, const BitWord &row) {
  double number = 0;
  for (std::uint32_t bit = 0; bit < row.bits; ++bit) {
    const auto value =
        context.interpretation.constantOf(context.interpretation.asNumber(storedValue(context, row.firstBit + bit)));
    const bool isBit = value == 0.0 || (value == 1.0 && bit < row.sureBits);
    if (!isBit)
      return context.interpretation.volatileRead(row.word);
    number += *value * std::ldexp(1.0, static_cast<int>(bit));
  }
  return context.interpretation.number(number);
}

/// The variable shows an offset of G52.
template <ValueAlgebra R> bool isLocalShift(const StepContext<R> &context, std::uint32_t cell) {
  return context.behaviour().localShiftIsVariable && cell >= kFirstWorkOffset && cell < kFirstWorkOffset + kAxisCount;
}

template <ValueAlgebra R>
typename R::Value readSystem(StepContext<R> &context, const VariableRange &range, std::uint32_t number) {
  R &interpretation = context.interpretation;
  if (isLocalShift(context, number)) // in force at the start, or given since
    return interpretation.either(interpretation.asNumber(context.state.local[number - kFirstWorkOffset]),
                                 interpretation.anyNumber());
  switch (range.role) {
  case VariableRole::Plain:
  case VariableRole::Stored:
  case VariableRole::WorkOffset:
  case VariableRole::AdditionalWorkOffset:
  case VariableRole::SetOffset:
  case VariableRole::WorkRotation:
  case VariableRole::Reference:
  case VariableRole::SecondReference: return storedValue(context, number);
  case VariableRole::SkipPosition: return interpretation.asHeld(storedValue(context, number));
  case VariableRole::Signal: return interpretation.signalRead(number, 0, 1);
  case VariableRole::SignalWord: // what the last of 32 bits counts for, manuals tell in two ways
    return interpretation.signalRead(number, -2147483648.0, 4294967295.0);
  case VariableRole::Volatile:
  case VariableRole::Clock:
  case VariableRole::Alarm:
  case VariableRole::MessageStop: return interpretation.volatileRead(number);
  case VariableRole::ModalCode: {
    const std::uint32_t group = number - range.first + 1;
    return group < kModalGroups ? interpretation.numberOfCode(context.state.codes[group], context.modes,
                                                              static_cast<std::uint8_t>(group))
                                : interpretation.anyNumber();
  }
  case VariableRole::ModalWord: {
    const std::optional<char> letter = letterOfModalWord(number - range.first + 1);
    return letter ? context.state.word(*letter) : interpretation.volatileRead(number);
  }
  case VariableRole::BlockEndPosition:
  case VariableRole::MachinePosition:
  case VariableRole::WorkPosition: return interpretation.asHeld(readPosition(context, range, number));
  case VariableRole::Pi: return interpretation.number(3.14159265358979323846);
  case VariableRole::EulersNumber: return interpretation.number(2.71828182845904523536);
  case VariableRole::Predefined:
    if (const PredefinedName *name = findPredefinedName(context.dialect(), number))
      return readPredefined(context, *name);
    break;
  }
  return interpretation.anything();
}

/// A name that a program chooses.  What the machine gives may change, but not whether it gives something.
template <ValueAlgebra R> typename R::Value readNamed(StepContext<R> &context, std::uint32_t number) {
  const auto stored = storedValue(context, number);
  if (!context.programs.isInputName(number))
    return stored;
  return context.interpretation.select(context.interpretation.isVacant(stored), stored,
                                       context.interpretation.volatileRead(number));
}

template <ValueAlgebra R> typename R::Value readAsStored(StepContext<R> &context, std::uint32_t number, Span place) {
  R &interpretation = context.interpretation;
  if (number == kVacantVariable)
    return interpretation.vacant();
  if (number >= kFirstNamedVariable)
    return readNamed(context, number);
  const VariableRange *range = findVariable(context.dialect(), number);
  if (!range) {
    interpretation.alarm(interpretation.truth(true), {AlarmKind::VariableNotAvailable, place});
    return interpretation.anything();
  }
  if (range->kind == VariableKind::Local && number <= kLocalVariables)
    return context.state.locals[number];
  if (range->kind == VariableKind::Vacant)
    return interpretation.vacant();
  if (range->access == VariableAccess::WriteOnly)
    interpretation.alarm(interpretation.truth(true), {AlarmKind::ReadProtected, place});
  if (const BitWord *row = findBitWord(context.dialect(), number))
    return readBits(context, *row);
  const std::uint32_t cell = cellOf(context.dialect(), number);
  const VariableRange *kept = cell == number ? range : findVariable(context.dialect(), cell);
  return kept ? readSystem(context, *kept, cell) : interpretation.anything();
}

/// A work offset in force is changed: the machine stands still, its work coordinates change.
template <ValueAlgebra R>
void writeWorkOffset(StepContext<R> &context, std::uint32_t number, const typename R::Value &value) {
  R &interpretation = context.interpretation;
  const std::uint32_t axis = (number - kFirstWorkOffset) % kWorkOffsetStride;
  const std::uint32_t written = number - axis; // its variable of X
  const auto moved = interpretation.subtract(offsetVariable(context, number), interpretation.asNumber(value));
  context.state.variables.set(number, value);
  if (axis >= kAxisCount)
    return;
  const std::optional<std::uint32_t> inForce = workOffsetInForce(context);
  if (written == kFirstWorkOffset || inForce == written) // the external one, or that in force
    shiftCoordinate(context, kAllAxes[axis], moved);
  else if (!inForce)
    shiftCoordinate(context, kAllAxes[axis], interpretation.anyNumber());
}

/// Until its system is selected next, an origin in force is another than its variable shows.
template <ValueAlgebra R>
void writeWaitingOrigin(StepContext<R> &context, std::uint32_t number, typename R::Value value, Span place) {
  const std::uint32_t written = number - (number - kFirstWorkOffset) % kWorkOffsetStride;
  context.state.variables.set(number, std::move(value));
  if (workOffsetInForce(context).value_or(written) != written)
    return;
  havocOrigins(context);
  context.interpretation.unmodelled("an origin that is written while its coordinate system may be in force", place);
}

/// Whether the system is selected before anything moves is not asked.
template <ValueAlgebra R>
void writeRotation(StepContext<R> &context, const typename R::Value &angle, typename R::Truth when, Span place) {
  R &interpretation = context.interpretation;
  const auto isTurned = interpretation.negation(interpretation.compare(Relation::Equal, angle, context.zero()));
  const auto turns = interpretation.both(when, isTurned);
  if (!interpretation.mayBe(turns))
    return;
  enterOtherGeometry(context, kLastingGeometry, turns);
  interpretation.unmodelled("a rotation that is written for a coordinate system", place);
}

/// Some variable of the control may have been written.
template <ValueAlgebra R> void loseOrigins(StepContext<R> &context, Span place) {
  havocOrigins(context);
  if (rangeWithRole(context.dialect(), VariableRole::WorkRotation))
    writeRotation(context, context.interpretation.anyNumber(), context.interpretation.unknownTruth(), place);
}

template <ValueAlgebra R>
void writeAdditionalOffset(StepContext<R> &context, std::uint32_t number, typename R::Value value, Span place) {
  if (workOffsetInForce(context))
    return writeWorkOffset(context, number, value);
  context.state.variables.set(number, std::move(value));
  havocOrigins(context);
  context.interpretation.unmodelled("a change of an additional work offset while one may be active", place);
}

template <ValueAlgebra R>
void writeCell(StepContext<R> &context, const VariableRange &range, std::uint32_t cell, typename R::Value value,
               Span place) {
  R &interpretation = context.interpretation;
  if (range.kind == VariableKind::System) // cells of the control hold numbers
    value = interpretation.asNumber(value);
  if (range.role == VariableRole::WorkOffset)
    return context.behaviour().writtenOriginWaits ? writeWaitingOrigin(context, cell, std::move(value), place)
                                                  : writeWorkOffset(context, cell, value);
  if (range.role == VariableRole::WorkRotation)
    writeRotation(context, value, interpretation.truth(true), place);
  if (isLocalShift(context, cell)) { // G52 by another way, which is not followed
    havocOrigins(context);
    interpretation.unmodelled("the offset of G52 written through its variable", place);
  }
  if (range.role == VariableRole::AdditionalWorkOffset)
    return writeAdditionalOffset(context, cell, std::move(value), place);
  changeLengthOffset(context, cell);
  changeTipOffset(context, range, cell);
  if (range.role != VariableRole::MessageStop && !isVolatile(range.role))
    context.state.variables.set(cell, std::move(value));
  else if constexpr (requires { interpretation.writesUnkept(cell); })
    if (isVolatile(range.role))
      interpretation.writesUnkept(cell);
}

/// Bits beyond those that are certain keep what they hold, or not.
template <ValueAlgebra R> void writeBits(StepContext<R> &context, const BitWord &row, const typename R::Value &value) {
  R &interpretation = context.interpretation;
  const auto number = interpretation.constantOf(interpretation.roundTo(interpretation.asNumber(value), Decimal(1, 0)));
  const bool isKnown = number && *number >= 0 && *number < std::ldexp(1.0, static_cast<int>(row.bits));
  const auto bits = isKnown ? static_cast<std::uint64_t>(*number) : 0;
  for (std::uint32_t bit = 0; bit < row.bits; ++bit) {
    const auto written = isKnown ? interpretation.number((bits >> bit & 1U) != 0 ? 1 : 0)
                                 : interpretation.between(interpretation.number(0), interpretation.number(1));
    const std::uint32_t cell = row.firstBit + bit;
    context.state.variables.set(
        cell, bit < row.sureBits ? written
                                 : interpretation.either(written, interpretation.asNumber(storedValue(context, cell))));
  }
}

} // namespace detail

template <ValueAlgebra R> typename R::Value readVariable(StepContext<R> &context, std::uint32_t number, Span place) {
  auto value = detail::readAsStored(context, number, place);
  if constexpr (requires { context.interpretation.asRead(value); }) // a position is counted in increments
    value = context.interpretation.asRead(value);
  if (context.behaviour().variablesMayBeVacant)
    return value;
  if (number < kFirstNamedVariable)
    return context.interpretation.asNumber(value);
  const auto isUnset = context.interpretation.isVacant(value);
  if (context.passesDefinition)
    return context.interpretation.select(isUnset, context.interpretation.anyNumber(),
                                         context.interpretation.asNumber(value));
  context.interpretation.alarm(isUnset, {AlarmKind::VariableNotAvailable, place});
  return context.interpretation.asNumber(value);
}

template <ValueAlgebra R>
void writeVariable(StepContext<R> &context, std::uint32_t number, typename R::Value value, Span place) {
  R &interpretation = context.interpretation;
  if (number >= kFirstNamedVariable && (context.programs.isInputName(number) || context.programs.isSettingName(number)))
    return interpretation.havoc(context.state, "an assignment to a name to which the machine may give a value", place);
  if (number >= kFirstNamedVariable)
    return context.state.variables.set(number, std::move(value));
  const VariableRange *range = findVariable(context.dialect(), number);
  if (!range) {
    interpretation.alarm(interpretation.truth(true), {AlarmKind::VariableNotAvailable, place});
    return;
  }
  if (range->access == VariableAccess::ReadOnly) {
    interpretation.alarm(interpretation.truth(true), {AlarmKind::WriteProtected, place});
    return;
  }
  if (range->kind == VariableKind::Local && number <= kLocalVariables) {
    context.state.locals[number] = std::move(value);
    return;
  }
  if (range->role == VariableRole::Alarm)
    return interpretation.userAlarm(value, place);
  if (const BitWord *row = findBitWord(context.dialect(), number))
    return detail::writeBits(context, *row, value);
  const std::uint32_t cell = cellOf(context.dialect(), number);
  for (const std::uint32_t other : perhapsSameAs(context.dialect(), cell))
    if (const VariableRange *otherRange = findVariable(context.dialect(), other))
      detail::writeCell(context, *otherRange, other, interpretation.either(value, detail::storedValue(context, other)),
                        place);
  if (const VariableRange *kept = findVariable(context.dialect(), cell))
    detail::writeCell(context, *kept, cell, std::move(value), place);
}

} // namespace feedhold
