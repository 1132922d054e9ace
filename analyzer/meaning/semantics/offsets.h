// Offsets: the codes that move the zero point of the program by their axis words: G52, G92 and what ends or brings back
// its offset, G10.  The machine stands still; its coordinates in the program change.
#pragma once

#include "meaning/semantics/executed_words.h"
#include "meaning/semantics/tool_length.h"

namespace feedhold {

template <ValueAlgebra R> class Offsets {
public:
  using Value = typename R::Value;
  using Truth = typename R::Truth;

  Offsets(StepContext<R> &context, const ExecutedWords<R> &words)
      : context_(context), interpretation_(context.interpretation), state_(context.state), words_(words) {}

  /// Whether the code is one of these; then it has been carried out.
  bool carryOut(const CodeWord &word) {
    switch (kindOf(*word.code)) {
    case Kind::None: return false;
    case Kind::LocalShift: localShift(); return true;
    case Kind::Set: set(); return true;
    case Kind::SetOff: setOff(Kept::No); return true;
    case Kind::Suspend: setOff(Kept::Yes); return true;
    case Kind::Restore: restore(); return true;
    case Kind::Data: setData(word); return true;
    }
    return false;
  }
  static bool isOne(const Code &code) { return kindOf(code) != Kind::None; }

private:
  enum class Kind { None, LocalShift, Set, SetOff, Suspend, Restore, Data };
  enum class Kept { No, Yes };

  static Kind kindOf(const Code &code) {
    constexpr std::array kRows = {
        std::pair{CodeAction::LocalShift, Kind::LocalShift},
        std::pair{CodeAction::CoordinateSet, Kind::Set},
        std::pair{CodeAction::CoordinateSetOff, Kind::SetOff},
        std::pair{CodeAction::CoordinateSetSuspend, Kind::Suspend},
        std::pair{CodeAction::CoordinateSetRestore, Kind::Restore},
    };
    for (const auto &[action, kind] : kRows)
      if (code.action == action)
        return kind;
    return code.role == CodeRole::DataSetting ? Kind::Data : Kind::None;
  }

  // ---- G52, G92 ----

  /// G52: the named axes.
  void localShift() {
    auto &shifts = context_.behaviour().oneSetOffset ? state_.shift : state_.local;
    for (const Axis axis : kAllAxes)
      if (const auto *entry = words_.find(letterOf(axis)))
        moveTo(shifts, axis, interpretation_.select(entry->present, entry->value, shifts[indexOf(axis)]));
    keep();
  }
  /// G92: the tool stands, from now on, at the named coordinates.
  void set() {
    if constexpr (requires { interpretation_.readPosition(Axis::X); }) // a lost one would become a zero point
      for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
        if (words_.find(letterOf(axis)))
          interpretation_.readPosition(axis);
    if (interpretation_.mayBe(state_.transformed))
      return setSomehow("a coordinate system set during mirroring, scaling or rotation");
    if (namesIncrements(context_, words_)) // `G50 U1.`
      return setSomehow("a coordinate system shifted by increments");
    for (const Axis axis : kAllAxes)
      if (const auto *entry = words_.find(letterOf(axis))) {
        const Value position = state_.at(axis);
        Value &shift = state_.shift[indexOf(axis)];
        const Value target = interpretation_.select(entry->present, entry->value, position);
        shift = interpretation_.add(shift, interpretation_.subtract(position, target));
        endLocal(axis, entry->present);
        shiftCoordinate(context_, axis, interpretation_.subtract(target, position));
        state_.at(axis) = target;
      }
    keep();
  }
  void setSomehow(std::string_view what) {
    for (auto *numbers : {&state_.shift, &state_.position})
      for (Value &number : *numbers)
        number = interpretation_.either(number, interpretation_.anyNumber());
    interpretation_.unmodelled(what, context_.place());
    keep();
  }
  /// NCT: G92 deletes the offset of G52; other manuals do not say.  The zero point is the same either way.
  void endLocal(Axis axis, Truth when) {
    Value &local = state_.local[indexOf(axis)];
    Value &shift = state_.shift[indexOf(axis)];
    const Truth ends = interpretation_.both(when, context_.isOn(&Switches::setEndsLocal));
    if (!interpretation_.mayBe(ends) ||
        context_.certain(interpretation_.compare(Relation::Equal, local, context_.zero())))
      return;
    shift = interpretation_.select(ends, interpretation_.add(shift, local), shift);
    local = interpretation_.select(ends, context_.zero(), local);
  }
  void setOff(Kept kept) {
    for (const Axis axis : kAllAxes)
      moveTo(state_.shift, axis, context_.zero());
    if (kept == Kept::No)
      keep();
  }
  void restore() {
    const VariableRange *range = rangeWithRole(context_.dialect(), VariableRole::SetOffset);
    for (const Axis axis : kAllAxes)
      if (range)
        moveTo(state_.shift, axis,
               detail::offsetVariable(context_, range->first + static_cast<std::uint32_t>(indexOf(axis))));
  }
  void moveTo(std::array<Value, kAxisCount> &shifts, Axis axis, const Value &wanted) {
    Value &shift = shifts[indexOf(axis)];
    shiftCoordinate(context_, axis, interpretation_.subtract(shift, wanted));
    shift = wanted;
  }
  void keep() {
    const VariableRange *range = rangeWithRole(context_.dialect(), VariableRole::SetOffset);
    for (std::uint32_t axis = 0; range && axis < kAxisCount; ++axis)
      state_.variables.set(range->first + axis, state_.shift[axis]);
  }

  // ---- G10 ----

  void setData(const CodeWord &word) {
    const auto *kind = words_.find('L');
    const std::optional<double> which = kind ? interpretation_.constantOf(kind->value) : std::nullopt;
    const std::optional<std::uint32_t> first = firstOfSystem();
    if (which == 50.0 || which == 52.0)
      return interpretation_.abandon("control parameters set by G10", word.span);
    if (which && isOfTools(*which))
      return setToolOffset(word, *which);
    turnSystem(word, which);
    if (first && which == 2.0)
      return setWorkOffset(*first);
    if (first && which == 20.0 && context_.behaviour().positionByData)
      return setPosition(*first);
    havocStored(word);
  }
  /// The first variable of the work offset that P names: 0 is the external one, or where there is none, that in force.
  std::optional<std::uint32_t> firstOfSystem() {
    const auto *system = words_.find('P');
    const std::optional<double> number = system ? interpretation_.constantOf(system->value) : std::nullopt;
    if (!number || *number < 0 || *number > 9)
      return std::nullopt;
    const auto row = static_cast<std::uint32_t>(*number);
    if (row == 0 && context_.behaviour().localShiftIsVariable)
      return std::nullopt; // the offset of G52
    const VariableRange *external = findVariable(context_.dialect(), kFirstWorkOffset);
    if (row == 0 && (!external || external->role != VariableRole::WorkOffset))
      return detail::workOffsetInForce(context_);
    const std::uint32_t first = kFirstWorkOffset + kWorkOffsetStride * row;
    const VariableRange *range = findVariable(context_.dialect(), first);
    return range && range->role == VariableRole::WorkOffset ? std::optional(first) : std::nullopt;
  }
  /// R of L2 turns the coordinate system.
  void turnSystem(const CodeWord &word, std::optional<double> which) {
    const auto *angle = words_.find('R');
    if (!angle || (which && which != 2.0))
      return;
    const Truth isSystem = which ? interpretation_.truth(true) : interpretation_.unknownTruth();
    const Truth isAngle =
        interpretation_.negation(interpretation_.compare(Relation::Equal, angle->value, context_.zero()));
    const Truth turns = interpretation_.both(interpretation_.both(angle->present, isAngle), isSystem);
    if (!interpretation_.mayBe(turns))
      return;
    detail::enterOtherGeometry(context_, kLastingGeometry, turns);
    interpretation_.unmodelled("a work coordinate system rotated by G10", word.span);
  }
  void setWorkOffset(std::uint32_t first) {
    const Truth always = interpretation_.truth(true);
    const Truth absolute = context_.behaviour().dataIsAbsolute
                               ? always
                               : context_.inForce(ModalKind::Distance, {CodeAction::Absolute}, always);
    for (const Axis axis : kAllAxes)
      if (const auto *entry = words_.find(letterOf(axis))) {
        const std::uint32_t variable = first + static_cast<std::uint32_t>(indexOf(axis));
        const Value old = detail::offsetVariable(context_, variable);
        const Value wanted = interpretation_.select(absolute, entry->value, interpretation_.add(old, entry->value));
        detail::writeWorkOffset(context_, variable, interpretation_.select(entry->present, wanted, old));
      }
  }
  /// The offset with which the axes, where they stand, would be at the named coordinates.
  void setPosition(std::uint32_t first) {
    const auto inForce = detail::workOffsetInForce(context_);
    for (const Axis axis : kAllAxes)
      if (const auto *entry = words_.find(letterOf(axis))) {
        const auto number = static_cast<std::uint32_t>(indexOf(axis));
        const Value present =
            inForce ? detail::offsetVariable(context_, *inForce + number) : interpretation_.anyNumber();
        const Value wanted = interpretation_.subtract(interpretation_.add(present, state_.at(axis)), entry->value);
        const Value old = detail::offsetVariable(context_, first + number);
        detail::writeWorkOffset(context_, first + number, interpretation_.select(entry->present, wanted, old));
      }
  }
  /// Of a mill: L10 geometry and L11 wear of H, L12 geometry and L13 wear of D (the operator's manuals of FANUC and
  /// Mitsubishi, G10 of Haas).  No zero point changes.
  bool isOfTools(double which) const {
    return context_.dialect().machine == MachineKind::Milling && context_.behaviour().cutterOffsets.count != 0 &&
           (which == 10.0 || which == 11.0 || which == 12.0 || which == 13.0);
  }
  void setToolOffset(const CodeWord &word, double which) {
    const OffsetMemory &memory = context_.behaviour().cutterOffsets;
    const auto first = which == 12.0 ? memory.geometry : memory.wear;
    const auto *number = words_.find('P');
    const auto *value = words_.find('R');
    const std::optional<double> row = number ? interpretation_.constantOf(number->value) : std::nullopt;
    const bool isAbsolute =
        context_.behaviour().dataIsAbsolute ||
        context_.certain(context_.inForce(ModalKind::Distance, {CodeAction::Absolute}, interpretation_.truth(true)));
    const bool isKnown = which >= 12.0 && first[1] == 0 && row && *row >= 1 && *row <= memory.count &&
                         *row == std::floor(*row) && value && context_.certain(value->present) && isAbsolute;
    if (isKnown)
      return writeVariable(context_, first[0] + static_cast<std::uint32_t>(*row) - 1,
                           interpretation_.asNumber(value->value), word.span);
    havocStored(word, ZeroPoints::Kept);
  }
  enum class ZeroPoints { Kept, Open };
  void havocStored(const CodeWord &word, ZeroPoints zeroPoints = ZeroPoints::Open) {
    const bool keeps = zeroPoints == ZeroPoints::Kept;
    for (const VariableRange &range : context_.dialect().variables)
      if (range.role == VariableRole::Stored ||
          (!keeps && (range.role == VariableRole::WorkOffset || range.role == VariableRole::AdditionalWorkOffset)))
        interpretation_.havocVariables(state_, range.first, range.last);
    if (!keeps)
      havocOrigins(context_);
    forgetLength(context_);
    interpretation_.unmodelled("offsets set by G10", word.span);
  }

  StepContext<R> &context_;
  R &interpretation_;
  MachineState<R> &state_;
  const ExecutedWords<R> &words_;
};

} // namespace feedhold
