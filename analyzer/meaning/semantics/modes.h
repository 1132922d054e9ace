// Modes: what the codes of a block change before anything moves: modal state, units, zero points, mappings, spindle.
#pragma once

#include "meaning/semantics/cycles.h"

#include <bit>

namespace feedhold {

/// Takes over all modal codes and words of the block (F, S, T, D, H ..).
template <ValueAlgebra R> void applyModes(StepContext<R> &context, const ExecutedWords<R> &words);

// ---- implementation -----------------------------------------------------------------------------------------------

namespace detail {

template <ValueAlgebra R> class Modes {
public:
  using Value = typename R::Value;
  using Truth = typename R::Truth;

  Modes(StepContext<R> &context, const ExecutedWords<R> &words)
      : context_(context), reading_(context.reading), state_(context.state), words_(words) {}

  void run() {
    if (!words_.codes.empty() || !words_.computed.empty())
      codes();
    modalWords();
  }

private:
  void codes() {
    switchUnits();
    const bool shifts = changesWorkOffset();
    const auto before = shifts ? originsOf(context_) : std::array<Value, kAxisCount>{};
    const bool maps = changesMapping();
    if (maps)
      leaveUnknownMappings();
    for (const CodeWord &word : words_.codes)
      enter(word);
    computedCodes();
    cancelCycle();
    if (shifts)
      moveOrigins(context_, before);
    length();
    if (maps)
      mappings();
  }

  void enter(const CodeWord &word) {
    const CodeAction action = word.code->action;
    if (word.address == 'G') {
      if (const auto index = context_.modes.indexOf(*word.code))
        state_.codes[word.code->group] = reading_.code(*index);
      if (word.code->group != 0 && word.code->group == context_.modes.groupOf(ModalKind::Cycle) &&
          !isDrillingCycle(action))
        endCycle(context_);
      if (action == CodeAction::Unmodelled || (action == CodeAction::Incremental && !hasDistanceModes())) {
        forgetPosition(context_);
        reading_.notModelled(word.code->meaning, word.span);
      }
      return;
    }
    for (std::size_t i = 0; i < kSpindleActions.size(); ++i)
      if (action == kSpindleActions[i])
        state_.spindle = reading_.code(static_cast<std::uint8_t>(i));
  }
  /// `G#1` where #1 holds what #4003 said: the mode is restored, and with it whatever depends on it.
  void computedCodes() {
    for (const auto &[group, code] : words_.computed) {
      state_.codes[group] = code;
      const auto is = [&, of = group](std::initializer_list<ModalKind> kinds) {
        return std::any_of(kinds.begin(), kinds.end(),
                           [&](ModalKind kind) { return context_.modes.groupOf(kind) == of; });
      };
      if (is({ModalKind::Units, ModalKind::WorkOffset, ModalKind::Length, ModalKind::Cycle}))
        forgetPosition(context_);
      if (is({ModalKind::Units}))
        for (auto *lengths : {&state_.shift, &state_.local})
          lengths->fill(reading_.anyNumber());
      if (is({ModalKind::Units, ModalKind::Length}))
        state_.lengthOffset = reading_.anyNumber();
      if (is({ModalKind::Units, ModalKind::Cycle}))
        for (Value *level : {&state_.cycle.bottom, &state_.cycle.retract, &state_.cycle.initial, &state_.cycle.peck,
                             &state_.cycle.dwell})
          *level = reading_.anything();
    }
  }
  bool hasDistanceModes() const { return context_.modes.groupOf(ModalKind::Distance).has_value(); }

  /// A code of group 01 ends a canned cycle where cycles have a group of their own.
  void cancelCycle() {
    const auto cycle = context_.modes.groupOf(ModalKind::Cycle);
    const auto motion = context_.modes.groupOf(ModalKind::Motion);
    if (!cycle || !motion || cycle == motion)
      return;
    bool moves = false;
    for (const auto &[group, code] : words_.computed) {
      if (group == *cycle)
        return;
      moves = moves || group == *motion;
    }
    for (const CodeWord &word : words_.codes) {
      if (word.address == 'G' && word.code->group == *cycle)
        return;
      moves = moves || (word.address == 'G' && word.code->group == *motion);
    }
    if (!moves)
      return;
    state_.codes[*cycle] = codeOfAction(ModalKind::Cycle, CodeAction::CycleOff);
    endCycle(context_);
  }
  typename R::ModalCode codeOfAction(ModalKind kind, CodeAction action) {
    const CodeMask mask = context_.modes.maskOf(kind, {action});
    return reading_.code(static_cast<std::uint8_t>(std::countr_zero(mask)));
  }

  // ---- units ----

  void switchUnits() {
    for (const CodeWord &word : words_.codes)
      if (word.code->action == CodeAction::Inch)
        rescale(CodeAction::Inch, Decimal(254, 1));
      else if (word.code->action == CodeAction::Metric)
        rescale(CodeAction::Metric, Decimal(254, 1));
  }
  /// Lengths that are kept go over into the new units.
  void rescale(CodeAction to, Decimal ratio) {
    const Truth already = context_.inForce(ModalKind::Units, {to}, reading_.truth(true));
    if (context_.certain(already))
      return;
    const Value factor = reading_.literal(ratio);
    const auto converted = [&](Value &length) {
      const Value other =
          to == CodeAction::Metric ? reading_.multiply(length, factor) : reading_.divide(length, factor);
      length = reading_.select(already, length, other);
    };
    for (const Axis axis : kAllAxes)
      if (isLinear(axis)) {
        converted(state_.position[indexOf(axis)]);
        converted(state_.shift[indexOf(axis)]);
        converted(state_.local[indexOf(axis)]);
      }
    converted(state_.lengthOffset);
    rescaleStored(to, factor, already);
    for (Value *level : {&state_.cycle.bottom, &state_.cycle.retract, &state_.cycle.initial, &state_.cycle.peck})
      *level = reading_.select(reading_.isVacant(*level), *level, convertedCopy(*level, to, factor, already));
  }
  /// Offsets and positions in variables are read in the units in force.
  void rescaleStored(CodeAction to, const Value &factor, Truth already) {
    constexpr std::array kLengths = {VariableRole::WorkOffset, VariableRole::SetOffset, VariableRole::Reference,
                                     VariableRole::SecondReference, VariableRole::SkipPosition};
    for (const VariableRange &range : context_.dialect().variables) {
      if (std::find(kLengths.begin(), kLengths.end(), range.role) == kLengths.end())
        continue;
      std::vector<std::pair<std::uint32_t, Value>> known;
      for (const auto &[variable, value] : state_.variables.entries())
        if (range.first <= variable && variable <= range.last)
          known.emplace_back(variable, convertedCopy(value, to, factor, already));
      reading_.forgetVariables(state_, range.first, range.last);
      for (auto &[variable, value] : known)
        state_.variables.set(variable, std::move(value));
    }
  }
  Value convertedCopy(const Value &level, CodeAction to, const Value &factor, Truth already) {
    const Value length = reading_.asNumber(level);
    const Value other = to == CodeAction::Metric ? reading_.multiply(length, factor) : reading_.divide(length, factor);
    return reading_.select(already, length, other);
  }

  // ---- zero points ----

  bool changesWorkOffset() const {
    for (const CodeWord &word : words_.codes) {
      const CodeAction action = word.code->action;
      if (action == CodeAction::ExtendedWorkOffset || (action == CodeAction::WorkOffset && !inForceAlready(word)))
        return true;
    }
    return false;
  }
  bool inForceAlready(const CodeWord &word) const {
    const auto index = context_.modes.indexOf(*word.code);
    return index && word.code->action == CodeAction::WorkOffset &&
           reading_.onlyCode(state_.codes[word.code->group]) == index;
  }
  /// The tip of the tool gets another coordinate while the machine stands still.
  void length() {
    for (const CodeWord &word : words_.codes) {
      const CodeAction action = word.code->action;
      if (action == CodeAction::LengthOff)
        setLength(context_.zero());
      else if (action == CodeAction::LengthGiven)
        setLength(wordOr('Z', state_.lengthOffset));
      else if (action == CodeAction::LengthPlus || action == CodeAction::LengthMinus)
        setLength(reading_.toolLength(state_, wordOr('H', state_.word('H'))));
    }
  }
  void setLength(const Value &length) {
    const Value moved = reading_.subtract(state_.lengthOffset, length);
    state_.lengthOffset = length;
    state_.at(Axis::Z) = reading_.add(state_.at(Axis::Z), moved);
  }
  Value wordOr(char letter, const Value &otherwise) const {
    const auto *entry = words_.find(letter);
    return entry ? reading_.select(entry->present, entry->value, otherwise) : otherwise;
  }

  // ---- mirror, scaling, rotation ----

  bool changesMapping() const {
    for (const CodeAction action : {CodeAction::ScalingOn, CodeAction::ScalingOff, CodeAction::MirrorOn,
                                    CodeAction::MirrorOff, CodeAction::RotationOn, CodeAction::RotationOff})
      if (words_.has(action))
        return true;
    return false;
  }
  struct Mapping {
    ModalKind kind;
    CodeAction off;
    CodeAction on;
  };
  static constexpr std::array<Mapping, 3> kMappings = {{
      {ModalKind::Scaling, CodeAction::ScalingOff, CodeAction::ScalingOn},
      {ModalKind::Mirror, CodeAction::MirrorOff, CodeAction::MirrorOn},
      {ModalKind::Rotation, CodeAction::RotationOff, CodeAction::RotationOn},
  }};
  /// Positions are told under the mappings at the start of the run, whatever they were.  One that ends, or gives way to
  /// another, takes with it what was known.
  void leaveUnknownMappings() {
    for (const Mapping &mapping : kMappings) {
      if (!words_.has(mapping.off) && !words_.has(mapping.on))
        continue;
      const Truth off = context_.inForce(mapping.kind, {mapping.off}, reading_.truth(true));
      const Truth on = context_.inForce(mapping.kind, {mapping.on}, reading_.truth(false));
      if (!context_.certain(off) && !context_.certain(on))
        forgetPosition(context_);
    }
  }
  void mappings() {
    for (const CodeWord &word : words_.codes)
      enterMapping(word.code->action);
    state_.transformed = anyMapping();
  }
  void enterMapping(CodeAction action) {
    if (action == CodeAction::RotationOn)
      rotation();
    else if (action == CodeAction::RotationOff)
      state_.transform.angle = context_.zero();
    else if (action == CodeAction::MirrorOn)
      mirror();
    else if (action == CodeAction::MirrorOff)
      mirrorOff();
    else if (action == CodeAction::ScalingOn)
      scaling();
    else if (action == CodeAction::ScalingOff)
      state_.transform.scale.fill(reading_.number(1));
  }
  Truth anyMapping() {
    Truth any = reading_.negation(reading_.compare(Relation::Equal, state_.transform.angle, context_.zero()));
    for (const Axis axis : kAllAxes) {
      const Truth scaled = reading_.negation(
          reading_.compare(Relation::Equal, state_.transform.scale[indexOf(axis)], reading_.number(1)));
      const Truth mirrored = reading_.negation(reading_.isVacant(state_.transform.mirrorAt[indexOf(axis)]));
      any = context_.either(any, context_.either(scaled, mirrored));
    }
    return any;
  }
  /// G68 X Y R: the centre is where the tool stands when it is not written.
  void rotation() {
    const std::optional<Plane> plane = planeOf(context_);
    auto &[first, second] = state_.transform.centre;
    first = plane ? wordOr(letterOf(plane->first), state_.at(plane->first)) : reading_.anyNumber();
    second = plane ? wordOr(letterOf(plane->second), state_.at(plane->second)) : reading_.anyNumber();
    state_.transform.angle = plane ? wordOr('R', context_.zero()) : reading_.anyNumber();
  }
  void mirror() {
    for (const Axis axis : kAllAxes)
      if (const auto *entry = words_.find(letterOf(axis)))
        state_.transform.mirrorAt[indexOf(axis)] =
            reading_.select(entry->present, entry->value, state_.transform.mirrorAt[indexOf(axis)]);
  }
  /// G50.1 names the axes that are not mirrored any more; alone it ends all.
  void mirrorOff() {
    bool named = false;
    for (const Axis axis : kAllAxes)
      if (words_.find(letterOf(axis))) {
        state_.transform.mirrorAt[indexOf(axis)] = reading_.vacant();
        named = true;
      }
    if (!named)
      state_.transform.mirrorAt.fill(reading_.vacant());
  }
  /// G51 X Y Z P, or I J K for each axis.
  void scaling() {
    const Value all = wordOr('P', reading_.number(1));
    const std::array<char, 3> own = {'I', 'J', 'K'};
    for (std::size_t i = 0; i < own.size(); ++i) {
      state_.transform.scale[i] = wordOr(own[i], all);
      state_.transform.scaleCentre[i] = wordOr(letterOf(kAllAxes[i]), state_.position[i]);
      reading_.alarm(reading_.compare(Relation::Equal, state_.transform.scale[i], context_.zero()),
                     {AlarmKind::Overflow, context_.place()});
    }
  }

  // ---- words that stay in force ----

  void modalWords() {
    for (const char letter : kModalWords)
      if (const auto *entry = words_.find(letter)) {
        Value &kept = state_.word(letter);
        kept = reading_.select(entry->present, entry->value, kept);
      }
  }

  StepContext<R> &context_;
  R &reading_;
  MachineState<R> &state_;
  const ExecutedWords<R> &words_;
};

} // namespace detail

template <ValueAlgebra R> void applyModes(StepContext<R> &context, const ExecutedWords<R> &words) {
  detail::Modes<R>(context, words).run();
}

} // namespace feedhold
