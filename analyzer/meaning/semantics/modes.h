// Modes: what the codes of a block change before anything moves: modal state, units, zero points, mappings, spindle.
#pragma once

#include "meaning/semantics/cycles.h"
#include "meaning/semantics/tool_length.h"
#include "meaning/semantics/turret.h"
#include "meaning/semantics/work_offset_choice.h"

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
      : context_(context), interpretation_(context.interpretation), state_(context.state), words_(words),
        choice_(context, words) {}

  void run() {
    if (!words_.codes.empty() || !words_.computed.empty())
      codes();
    else
      otherNumber();
    modalWords();
  }

private:
  void codes() {
    switchUnits();
    const bool shifts = choice_.changesSystem();
    const auto before = shifts ? originsOf(context_) : std::array<Value, kAxisCount>{};
    const bool wasKnown = !shifts || detail::workOffsetInForce(context_);
    const bool maps = changesMapping();
    const std::optional<Plane> planeBefore = planeOf(context_);
    if (maps)
      leaveUnknownMappings();
    const Truth mapped = state_.transformed;
    const auto programmed = maps ? toProgrammed(context_, state_.position) : std::array<Value, kAxisCount>{};
    const Truth lengthOff = context_.inForce(ModalKind::Length, {CodeAction::LengthOff}, interpretation_.truth(true));
    for (const CodeWord &word : words_.codes)
      enter(word);
    computedCodes();
    alarmOfCompensation();
    cancelCycle();
    if (shifts)
      moveOrigins(context_, before);
    if constexpr (requires { interpretation_.losePosition(); })
      if (!wasKnown || (shifts && !detail::workOffsetInForce(context_)))
        interpretation_.losePosition();
    length(lengthOff);
    if (maps) {
      mappings();
      expectAbsolute(programmed, context_.either(mapped, state_.transformed));
    }
    otherPlane(planeBefore);
    forgetKeptAtCodes(context_, words_, planeBefore);
  }

  void enter(const CodeWord &word) {
    const CodeAction action = word.code->action;
    if (word.address == 'G') {
      beginCycle(word);
      if (hasTurret(context_))
        enterTurningCode(context_, action);
      if (const auto index = context_.modes.indexOf(*word.code))
        state_.codes[word.code->group] = interpretation_.code(*index);
      if (word.code->group != 0 && word.code->group == context_.modes.groupOf(ModalKind::Cycle) &&
          !isDrillingCycle(action))
        endCycle(context_);
      if (action == CodeAction::Unmodelled || (action == CodeAction::Incremental && !hasDistanceModes())) {
        havocPosition(context_);
        interpretation_.unmodelled(word.code->meaning, word.span);
      }
      if (choice_.mayBeAdditional(word))
        choice_.enterAdditional(word);
      enterOtherGeometry(word);
      return;
    }
    for (std::size_t i = 0; i < kSpindleActions.size(); ++i)
      if (action == kSpindleActions[i])
        state_.spindle = interpretation_.code(static_cast<std::uint8_t>(i));
  }
  /// Movements mean something else from here on: until another code of the group comes, or for good.  The codes of a
  /// plane's group (feature coordinates, planes of other axes) last until others than those of a plane end them, which
  /// is not followed.
  void enterOtherGeometry(const CodeWord &word) {
    const CodeAction action = word.code->action;
    const bool isModal = context_.modes.indexOf(*word.code).has_value();
    if (action == CodeAction::Unmodelled)
      enterOther(isModal && word.code->group != context_.modes.groupOf(ModalKind::Plane) ? kModalGeometry
                                                                                         : kLastingGeometry);
    else if (isModal && (action == CodeAction::OtherCycle || action == CodeAction::SideCycle))
      enterOther(kModalGeometry);
  }
  void enterOther(int what) { detail::enterOtherGeometry(context_, what, interpretation_.truth(true)); }
  /// What the control's manual forbids, or what is not told by a code in force.
  void notFollowed(Truth when, std::string_view what) {
    if (!interpretation_.mayBe(when))
      return;
    detail::enterOtherGeometry(context_, kLastingGeometry, when);
    interpretation_.unmodelled(what, context_.place());
  }

  /// `G#1` where #1 holds what #4003 said: the mode is restored, and with it whatever depends on it.
  void computedCodes() {
    if (hasTurret(context_) && !words_.computed.empty())
      endCycle(context_);
    for (const auto &[group, code] : words_.computed) {
      state_.codes[group] = code;
      if (const Truth other = interpretation_.isOneOf(code, otherGeometryMask(context_.modes.group(group)));
          interpretation_.mayBe(other))
        detail::enterOtherGeometry(context_, kModalGeometry, other);
      const auto is = [&, of = group](std::initializer_list<ModalKind> kinds) {
        return std::any_of(kinds.begin(), kinds.end(),
                           [&](ModalKind kind) { return context_.modes.groupOf(kind) == of; });
      };
      if (is({ModalKind::WorkOffset, ModalKind::Length}))
        havocOrigins(context_);
      if (is({ModalKind::WorkOffset}))
        state_.word('P') =
            interpretation_.select(context_.maybeNot(), interpretation_.vacant(), interpretation_.anyNumber());
      if (is({ModalKind::Units, ModalKind::Cycle}))
        havocPosition(context_);
      if (is({ModalKind::Units}))
        for (auto *lengths : {&state_.shift, &state_.local})
          lengths->fill(interpretation_.anyNumber());
      if (is({ModalKind::Units, ModalKind::Length}))
        state_.lengthOffset = interpretation_.anyNumber();
      if (is({ModalKind::Length}))
        state_.lengthChanged = interpretation_.truth(true);
      if (is({ModalKind::Units, ModalKind::Cycle}))
        for (Value *level : {&state_.cycle.bottom, &state_.cycle.retract, &state_.cycle.initial, &state_.cycle.peck,
                             &state_.cycle.dwell})
          *level = interpretation_.anything();
    }
  }
  /// A control stops where the tool does not fit into the contour, in this block or in one behind it.  Runs that follow
  /// the path of the tool's centre see it (machine/cutter_path.h); all others foresee it where the compensation begins.
  void alarmOfCompensation() {
    const auto begins = [](const CodeWord &word) { return beginsCompensation(word.code->action); };
    Truth any = interpretation_.truth(std::any_of(words_.codes.begin(), words_.codes.end(), begins));
    for (const auto &[group, code] : words_.computed) // `G#7`, where #7 holds what #4007 said
      if (group == context_.modes.groupOf(ModalKind::Compensation))
        any =
            context_.either(any, interpretation_.isOneOf(code, context_.modes.maskOf(ModalKind::Compensation,
                                                                                     {CodeAction::CompensationLeft,
                                                                                      CodeAction::CompensationRight})));
    interpretation_.alarm(interpretation_.both(any, context_.maybeNot()),
                          {AlarmKind::CutterCompensation, context_.place()});
  }
  /// What is left of a cycle has no part in one that begins.
  void beginCycle(const CodeWord &word) {
    const auto group = context_.modes.groupOf(ModalKind::Cycle);
    if (!isDrillingCycle(word.code->action) || word.code->group != group)
      return;
    const Truth off = context_.inForce(ModalKind::Cycle, {CodeAction::CycleOff}, interpretation_.truth(false));
    const Truth active =
        interpretation_.isOneOf(state_.codes[*group], context_.modes.maskOf(ModalKind::Cycle, kDrillingCycles));
    if (context_.certain(off) || !interpretation_.mayBe(active))
      endCycle(context_);
  }
  bool hasDistanceModes() const { return context_.modes.groupOf(ModalKind::Distance).has_value(); }

  /// A code of group 01 ends a canned cycle where cycles have a group of their own; one behind the code of a cycle may
  /// do so in the block in which that begins.
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
    bool begins = false;
    for (const CodeWord &word : words_.codes) {
      if (word.address != 'G')
        continue;
      if (word.code->group == *cycle && !isDrillingCycle(word.code->action))
        return;
      begins = begins || word.code->group == *cycle;
      moves = word.code->group != *cycle && (moves || word.code->group == *motion);
    }
    if (!moves)
      return;
    const Truth ends = begins ? context_.isOn(&Switches::motionEndsCycle) : interpretation_.truth(true);
    if (context_.certain(ends))
      return leaveCycle(*cycle);
    if (!interpretation_.mayBe(ends))
      return;
    const auto running = state_;
    leaveCycle(*cycle);
    interpretation_.join(state_, interpretation_.negation(ends), running);
  }
  void leaveCycle(std::uint8_t group) {
    state_.codes[group] = codeOfAction(ModalKind::Cycle, CodeAction::CycleOff);
    endCycle(context_);
  }
  typename R::ModalCode codeOfAction(ModalKind kind, CodeAction action) {
    const CodeMask mask = context_.modes.maskOf(kind, {action});
    return interpretation_.code(static_cast<std::uint8_t>(std::countr_zero(mask)));
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
    const Truth already = context_.inForce(ModalKind::Units, {to}, interpretation_.truth(true));
    if (context_.certain(already))
      return;
    const Value factor = interpretation_.literal(ratio);
    const auto converted = [&](Value &length) {
      const Value other =
          to == CodeAction::Metric ? interpretation_.multiply(length, factor) : interpretation_.divide(length, factor);
      length = interpretation_.select(already, length, other);
    };
    for (const Axis axis : kAllAxes)
      if (isLinear(axis)) {
        converted(state_.position[indexOf(axis)]);
        converted(state_.shift[indexOf(axis)]);
        converted(state_.local[indexOf(axis)]);
      }
    for (auto *lengths : {&state_.transform.scaleCentre, &state_.transform.mirrorAt})
      for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
        convertedIfAny((*lengths)[indexOf(axis)], to, factor, already);
    for (Value &length : state_.transform.centre)
      converted(length);
    converted(state_.lengthOffset);
    rescaleStored(to, factor, already);
    for (Value *level : {&state_.cycle.bottom, &state_.cycle.retract, &state_.cycle.initial, &state_.cycle.peck})
      convertedIfAny(*level, to, factor, already);
  }
  void convertedIfAny(Value &length, CodeAction to, const Value &factor, Truth already) {
    length =
        interpretation_.select(interpretation_.isVacant(length), length, convertedCopy(length, to, factor, already));
  }
  /// Offsets and positions in variables are read in the units in force.
  void rescaleStored(CodeAction to, const Value &factor, Truth already) {
    constexpr std::array kLengths = {VariableRole::WorkOffset,      VariableRole::AdditionalWorkOffset,
                                     VariableRole::SetOffset,       VariableRole::Reference,
                                     VariableRole::SecondReference, VariableRole::SkipPosition};
    for (const VariableRange &range : context_.dialect().variables) {
      if (std::find(kLengths.begin(), kLengths.end(), range.role) == kLengths.end())
        continue;
      std::vector<std::pair<std::uint32_t, Value>> known;
      for (const auto &[variable, value] : state_.variables.entries())
        if (range.first <= variable && variable <= range.last)
          known.emplace_back(variable, convertedCopy(value, to, factor, already));
      interpretation_.havocVariables(state_, range.first, range.last);
      for (auto &[variable, value] : known)
        state_.variables.set(variable, std::move(value));
    }
    forgetToolOffsets(context_.behaviour().lengthOffsets);
    forgetToolOffsets(context_.behaviour().cutterOffsets);
  }
  /// A parameter decides whether the control converts tool offsets, too (FANUC 5006#0, OIM).
  void forgetToolOffsets(const OffsetMemory &memory) {
    std::vector<std::pair<std::uint32_t, Value>> written;
    for (const auto &[variable, value] : state_.variables.entries())
      if (isOffsetVariable(context_.dialect(), memory, variable))
        written.emplace_back(variable, interpretation_.either(value, interpretation_.anyNumber()));
    for (const std::uint32_t first : {memory.geometry.front(), memory.wear.front()})
      for (const std::uint32_t low : {first, cellOf(context_.dialect(), first)})
        if (memory.count != 0)
          interpretation_.havocVariables(state_, low, low + memory.count - 1);
    for (auto &[variable, value] : written)
      state_.variables.set(variable, std::move(value));
  }
  Value convertedCopy(const Value &level, CodeAction to, const Value &factor, Truth already) {
    const Value length = interpretation_.asNumber(level);
    const Value other =
        to == CodeAction::Metric ? interpretation_.multiply(length, factor) : interpretation_.divide(length, factor);
    return interpretation_.select(already, length, other);
  }

  // ---- zero points ----

  /// The tip of the tool gets another coordinate while the machine stands still.
  void length(Truth wasOff) {
    bool isNamed = false;
    for (const CodeWord &word : words_.codes) {
      const CodeAction action = word.code->action;
      if (action == CodeAction::LengthOff)
        setLength(context_.zero(), interpretation_.negation(wasOff));
      else if (action == CodeAction::LengthGiven)
        setLength(wordOr('Z', state_.lengthOffset), interpretation_.truth(true));
      else if (action == CodeAction::LengthPlus || action == CodeAction::LengthMinus)
        setLength(lengthByNumber(action), interpretation_.truth(true));
      else
        continue;
      isNamed = true;
    }
    if (!isNamed)
      otherNumber();
  }
  /// `H2` alone: under G43 and G44 the length of another offset number comes into force, or a parameter keeps the old
  /// one (Mitsubishi #1274).  H0, and so a number that is not known, may cancel G43 as well.
  void otherNumber() {
    const auto *entry = words_.find('H');
    if (!entry || context_.behaviour().lengthOffsets.count == 0)
      return;
    const auto number = interpretation_.constantOf(entry->value);
    for (const CodeAction action : {CodeAction::LengthPlus, CodeAction::LengthMinus}) {
      const Truth changes = interpretation_.both(
          entry->present, context_.inForce(ModalKind::Length, {action}, interpretation_.truth(false)));
      if (!interpretation_.mayBe(changes))
        continue;
      if (!number || *number == 0)
        mayCancelLengthCode(context_, interpretation_.both(changes, context_.maybeNot()));
      setLength(interpretation_.select(changes, interpretation_.either(lengthByNumber(action), state_.lengthOffset),
                                       state_.lengthOffset),
                changes);
    }
  }
  Value lengthByNumber(CodeAction action) {
    const Value length = toolLengthOf(context_, wordOr('H', state_.word('H')));
    return action == CodeAction::LengthMinus ? interpretation_.negate(length) : length;
  }
  void setLength(const Value &length, Truth isNew) {
    const Value moved = interpretation_.subtract(state_.lengthOffset, length);
    state_.lengthOffset = length;
    state_.lengthChanged = context_.either(state_.lengthChanged, isNew);
    shiftCoordinate(context_, Axis::Z, moved);
    if (mayMoveByLength())
      moveByLength(moved);
  }
  /// Where a block brings Z to a coordinate, both come to the same.
  bool mayMoveByLength() {
    const auto *entry = words_.find('Z');
    const bool isPlaced = entry && context_.certain(entry->present) && context_.certain(detail::isAbsolute(context_));
    return context_.behaviour().lengthOffsets.count != 0 && !isPlaced;
  }
  /// The control changes the coordinate while the machine stands, or moves the machine and keeps the coordinate (FANUC
  /// 5006#6, TOS; Mitsubishi #1268).
  void moveByLength(const Value &shifted) {
    const auto start = state_.position;
    Value &z = state_.at(Axis::Z);
    z = interpretation_.either(z, interpretation_.subtract(z, shifted));
    if (!context_.certain(interpretation_.compare(Relation::Equal, z, start[indexOf(Axis::Z)])))
      tell(context_, MoveKind::Rapid, start);
  }
  Value wordOr(char letter, const Value &otherwise) const {
    const auto *entry = words_.find(letter);
    return entry ? interpretation_.select(entry->present, entry->value, otherwise) : otherwise;
  }

  // ---- mirror, scaling, rotation ----

  /// FANUC, Mitsubishi M700V: behind G69 the first movement has to be absolute.  Until then the control may take an
  /// axis to be at the coordinate that it had under the mapping that has changed.
  void expectAbsolute(const std::array<Value, kAxisCount> &before, Truth maps) {
    if (!interpretation_.mayBe(maps))
      return;
    const auto now = toProgrammed(context_, state_.position);
    for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
      Value &pending = state_.transform.pending[axis];
      const Truth same = interpretation_.both(interpretation_.compare(Relation::Equal, before[axis], now[axis]),
                                              interpretation_.isVacant(pending));
      const Value other = interpretation_.select(interpretation_.isVacant(pending), before[axis],
                                                 interpretation_.either(pending, interpretation_.anyNumber()));
      pending = interpretation_.select(same, interpretation_.vacant(), other);
    }
  }
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
      const Truth off = context_.inForce(mapping.kind, {mapping.off}, interpretation_.truth(true));
      const Truth on = context_.inForce(mapping.kind, {mapping.on}, interpretation_.truth(false));
      if (!context_.certain(off) && !context_.certain(on))
        havocPosition(context_);
    }
  }
  /// A control maps in one order: mirror images are given and ended outside scaling, and that outside rotation.
  void mappings() {
    const Truth turned = isTurned();
    const Truth scaledOrTurned = context_.either(turned, isScaled());
    const Truth mirrored = isMirrored();
    for (const CodeWord &word : words_.codes)
      enterMapping(word.code->action);
    const Truth stillTurned = interpretation_.both(turned, isTurned());
    const Truth stillMapped = interpretation_.both(scaledOrTurned, context_.either(isTurned(), isScaled()));
    if (words_.has(CodeAction::MirrorOn) || words_.has(CodeAction::MirrorOff))
      notFollowed(interpretation_.both(stillMapped, context_.either(mirrored, isMirrored())),
                  "a change of mirroring during scaling or rotation");
    if (words_.has(CodeAction::ScalingOn) || words_.has(CodeAction::ScalingOff))
      notFollowed(stillTurned, "a change of scaling during rotation");
    const Truth isRotation = interpretation_.truth(words_.has(CodeAction::RotationOn)); // by 0 as well: kept_words.h
    state_.transformed = context_.either(context_.either(context_.either(isTurned(), isRotation), isScaled()),
                                         context_.either(isMirrored(), isOther()));
  }
  void otherPlane(const std::optional<Plane> &before) {
    if (!interpretation_.mayBe(state_.transformed) || !namesPlane())
      return;
    const std::optional<Plane> now = planeOf(context_);
    if (!now || !before || now->normal != before->normal)
      notFollowed(isTurned(), "a change of plane during rotation");
  }
  bool namesPlane() const {
    const auto plane = context_.modes.groupOf(ModalKind::Plane);
    return words_.has(CodeAction::PlaneXY) || words_.has(CodeAction::PlaneZX) || words_.has(CodeAction::PlaneYZ) ||
           std::any_of(words_.computed.begin(), words_.computed.end(),
                       [&](const auto &computed) { return computed.first == plane; });
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
      state_.transform.scale.fill(interpretation_.number(1));
  }
  Truth isTurned() {
    return interpretation_.negation(interpretation_.compare(Relation::Equal, state_.transform.angle, context_.zero()));
  }
  Truth isScaled() {
    Truth any = interpretation_.truth(false);
    for (const Value &factor : state_.transform.scale)
      any = context_.either(
          any, interpretation_.negation(interpretation_.compare(Relation::Equal, factor, interpretation_.number(1))));
    return any;
  }
  Truth isMirrored() {
    Truth any = interpretation_.truth(false);
    for (const Value &at : state_.transform.mirrorAt)
      any = context_.either(any, interpretation_.negation(interpretation_.isVacant(at)));
    return any;
  }
  Truth isOther() { return interpretation_.negation(interpretation_.isVacant(state_.transform.other)); }

  /// G68 X Y R: the centre is where the tool stands when it is not written; the angle is then a parameter's.  Whether R
  /// counts from the angle in force under G91 is a parameter's too.
  void rotation() {
    if (words_.find('I') || words_.find('J') || words_.find('K'))
      notFollowed(interpretation_.truth(true), "three-dimensional rotation");
    const std::optional<Plane> plane = planeOf(context_);
    auto &[first, second] = state_.transform.centre;
    first = plane ? centreOfRotation(plane->first) : interpretation_.anyNumber();
    second = plane ? centreOfRotation(plane->second) : interpretation_.anyNumber();
    Value &angle = state_.transform.angle;
    const Value before = angle;
    angle = plane ? wordOrParameter('R', 0, "rotation by an angle from a parameter") : interpretation_.anyNumber();
    const Truth adds = interpretation_.both(
        context_.inForce(ModalKind::Distance, {CodeAction::Incremental}, interpretation_.truth(false)),
        interpretation_.negation(interpretation_.compare(Relation::Equal, before, context_.zero())));
    if (interpretation_.mayBe(adds))
      angle = interpretation_.select(adds, interpretation_.either(angle, interpretation_.add(before, angle)), angle);
  }
  Value centreOfRotation(Axis axis) {
    const Value present = mirrored(context_, indexOf(axis), state_.at(axis));
    const auto *entry = words_.find(letterOf(axis));
    return entry ? interpretation_.select(entry->present, scaled(context_, indexOf(axis), entry->value), present)
                 : present;
  }
  /// A parameter of the machine stands in for a word that is not written; a run takes `usual` for it.
  Value wordOrParameter(char letter, double usual, std::string_view otherwise) {
    const auto *entry = words_.find(letter);
    if (entry && context_.certain(entry->present))
      return entry->value;
    interpretation_.unmodelled(otherwise, context_.place());
    const Value parameter = interpretation_.either(interpretation_.number(usual), interpretation_.anyNumber());
    return entry ? interpretation_.select(entry->present, entry->value, parameter) : parameter;
  }
  void mirror() {
    for (const Axis axis : kAllAxes)
      if (const auto *entry = words_.find(letterOf(axis)))
        state_.transform.mirrorAt[indexOf(axis)] =
            interpretation_.select(entry->present, entry->value, state_.transform.mirrorAt[indexOf(axis)]);
  }
  /// G50.1 names the axes that are not mirrored any more; alone it ends all.
  void mirrorOff() {
    bool named = false;
    for (const Axis axis : kAllAxes)
      if (words_.find(letterOf(axis))) {
        state_.transform.mirrorAt[indexOf(axis)] = interpretation_.vacant();
        named = true;
      }
    if (!named)
      state_.transform.mirrorAt.fill(interpretation_.vacant());
  }
  /// G51 X Y Z P, or I J K for each axis; the centre is where the tool stands when it is not written.
  void scaling() {
    if (!context_.behaviour().scalingIsFollowed)
      notFollowed(interpretation_.truth(true), "scaling by this control");
    const std::array<char, 3> own = {'I', 'J', 'K'};
    for (std::size_t i = 0; i < own.size(); ++i)
      state_.transform.scaleCentre[i] = wordOr(letterOf(kAllAxes[i]), mirrored(context_, i, state_.position[i]));
    const Value all = factorOf('P', interpretation_.either(interpretation_.number(1), interpretation_.anyNumber()));
    bool written = words_.find('P') != nullptr;
    for (std::size_t i = 0; i < own.size(); ++i) {
      state_.transform.scale[i] = factorOf(own[i], all);
      written = written || words_.find(own[i]);
    }
    if (!written)
      interpretation_.unmodelled("scaling by a factor from a parameter", context_.place());
  }
  /// Or that of a parameter.
  Value factorOf(char letter, const Value &otherwise) {
    const auto *entry = words_.find(letter);
    if (!entry)
      return otherwise;
    const Value value = factor(letter, entry->value);
    interpretation_.alarm(
        interpretation_.both(entry->present, interpretation_.compare(Relation::Equal, value, context_.zero())),
        {AlarmKind::Overflow, context_.place()});
    return interpretation_.select(entry->present, value, otherwise);
  }
  /// As it is written: I, J, K are lengths elsewhere, and a number without a point would be taken for increments.
  Value factor(char letter, const Value &value) {
    Value written = value;
    for (const Word &word : context_.tree().wordsOf(context_.block))
      if (word.address() == letter && word.isNumber()) {
        written = interpretation_.literal(word.number());
        if (word.has(Word::kPoint))
          return written;
      }
    if (!context_.behaviour().scalesByIncrements)
      return written;
    return interpretation_.either(interpretation_.multiply(written, interpretation_.literal(Decimal(1, 3))),
                                  interpretation_.multiply(written, interpretation_.literal(Decimal(1, 5))));
  }

  // ---- words that stay in force ----

  void modalWords() {
    for (const char letter : kModalWords)
      if (const auto *entry = letter == 'P' ? nullptr : words_.find(letter)) { // choice_
        Value &kept = state_.word(letter);
        kept = interpretation_.select(entry->present, entry->value, kept);
      }
    if (const auto *tool = words_.find('T')) {
      changeTip(context_, tool->present);
      if (hasTurret(context_))
        state_.lengthChanged = context_.either(state_.lengthChanged, tool->present);
    }
  }

  StepContext<R> &context_;
  R &interpretation_;
  MachineState<R> &state_;
  const ExecutedWords<R> &words_;
  WorkOffsetChoice<R> choice_;
};

} // namespace detail

template <ValueAlgebra R> void applyModes(StepContext<R> &context, const ExecutedWords<R> &words) {
  detail::Modes<R>(context, words).run();
}

} // namespace feedhold
