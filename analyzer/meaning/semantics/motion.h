// Motion: where the axis words of a block lead: lines, arcs, skip, machine coordinates, reference return, shifts.
#pragma once

#include "meaning/semantics/arc_radii.h"
#include "meaning/semantics/cycles.h"
#include "meaning/semantics/modes.h"
#include "meaning/semantics/offsets.h"

#include <cmath>

namespace feedhold {

/// What the block does with its axis words, after its modes have been applied.
template <ValueAlgebra R> void applyMotion(StepContext<R> &context, const ExecutedWords<R> &words);

// ---- implementation -----------------------------------------------------------------------------------------------

namespace detail {

template <ValueAlgebra R> class Motion {
public:
  using Value = typename R::Value;
  using Truth = typename R::Truth;
  using Point = std::array<Value, kAxisCount>;

  Motion(StepContext<R> &context, const ExecutedWords<R> &words)
      : context_(context), interpretation_(context.interpretation), state_(context.state), words_(words) {}

  void run() {
    const bool others = namesOtherAxes();
    const Point before = others ? state_.position : Point{};
    act();
    if (const CodeWord *word = ownWords(); !word || isMovement(*word->code))
      settlePending(context_, words_);
    if ((!words_.entries.empty() || ownWords()) && interpretation_.mayBe(otherGeometry(context_))) {
      havocPosition(context_);
      state_.axisTurned = context_.either(state_.axisTurned, otherGeometry(context_));
    }
    if (words_.mayTakeAxes)
      state_.axisTurned = context_.either(state_.axisTurned, interpretation_.unknownTruth());
    if (others)
      noteOtherAxes(before);
  }

private:
  static bool isMovement(const Code &code) {
    constexpr std::array kMovements = {CodeAction::MachineMove, CodeAction::ReferenceReturn,
                                       CodeAction::SecondReference, CodeAction::ReferenceCheck, CodeAction::Skip};
    return std::find(kMovements.begin(), kMovements.end(), code.action) != kMovements.end();
  }
  static bool isOther(Axis axis) { return indexOf(axis) > indexOf(Axis::Z); }
  bool namesOtherAxes() const {
    return context_.dialect().machine == MachineKind::Milling &&
           std::any_of(kAllAxes.begin(), kAllAxes.end(),
                       [&](Axis axis) { return isOther(axis) && words_.find(letterOf(axis)); });
  }
  /// Such an axis turns the part, or moves it or the tool.
  void noteOtherAxes(const Point &before) {
    for (const Axis axis : kAllAxes)
      if (isOther(axis) && words_.find(letterOf(axis)))
        state_.axisTurned = context_.either(
            state_.axisTurned,
            interpretation_.negation(interpretation_.compare(Relation::Equal, before[indexOf(axis)], state_.at(axis))));
  }
  void act() {
    if (const CodeWord *word = ownWords())
      return consume(*word);
    const Truth cycle = cycleActive();
    const Truth moves =
        context_.either(axisWords(), interpretation_.both(isFullCircle(), interpretation_.negation(cycle)));
    if (!interpretation_.mayBe(moves))
      return;
    if (context_.certain(moves))
      return move(cycle, moves);
    const auto before = state_;
    move(cycle, moves);
    interpretation_.join(state_, interpretation_.negation(moves), before);
  }
  void move(Truth cycle, Truth moves) {
    if (context_.certain(cycle))
      return runCycle(context_, words_);
    if (!interpretation_.mayBe(cycle))
      return plain(moves);
    auto drilled = state_; // either: both are followed, and what they leave is joined
    plain(interpretation_.both(moves, interpretation_.negation(cycle)));
    std::swap(state_, drilled);
    runCycle(context_, words_);
    interpretation_.join(state_, interpretation_.negation(cycle), drilled);
  }

  // ---- what takes the axis words ----

  /// The code of the block, not modal, that takes the axis words for itself.
  const CodeWord *ownWords() const {
    for (const CodeWord &word : words_.codes)
      if (word.address == 'G' && takesWords(*word.code))
        return &word;
    return nullptr;
  }
  static bool takesWords(const Code &code) {
    constexpr std::array kTaking = {CodeAction::Dwell,
                                    CodeAction::LengthGiven,
                                    CodeAction::ReferenceStore,
                                    CodeAction::SecondReferenceStore,
                                    CodeAction::MachineMove,
                                    CodeAction::ReferenceReturn,
                                    CodeAction::SecondReference,
                                    CodeAction::ReferenceCheck,
                                    CodeAction::Skip,
                                    CodeAction::RotationOn,
                                    CodeAction::ScalingOn,
                                    CodeAction::MirrorOn,
                                    CodeAction::MirrorOff,
                                    CodeAction::Unmodelled,
                                    CodeAction::Anything,
                                    CodeAction::OtherCycle,
                                    CodeAction::TurningCycle,
                                    CodeAction::SideCycle};
    return Offsets<R>::isOne(code) || code.role == CodeRole::CoordinateShift ||
           std::find(kTaking.begin(), kTaking.end(), code.action) != kTaking.end();
  }
  void consume(const CodeWord &word) {
    const CodeAction action = word.code->action;
    if (action == CodeAction::Dwell)
      dwell();
    else if (action == CodeAction::MachineMove)
      machineMove();
    else if (action == CodeAction::ReferenceReturn || action == CodeAction::SecondReference)
      referenceReturn(word);
    else if (action == CodeAction::ReferenceStore)
      storeReference(VariableRole::Reference);
    else if (action == CodeAction::SecondReferenceStore)
      storeReference(VariableRole::SecondReference);
    else if (action == CodeAction::Skip)
      skip();
    else if (action == CodeAction::ReferenceCheck)
      referenceCheck();
    else if (action == CodeAction::TurningCycle)
      roundTrip(word.code->meaning, word.span);
    else if (action == CodeAction::OtherCycle || action == CodeAction::SideCycle || action == CodeAction::Unmodelled ||
             action == CodeAction::Anything)
      unmodelled(word);
    else
      Offsets<R>(context_, words_).carryOut(word);
  }
  void unmodelled(const CodeWord &word) {
    const Point start = state_.position;
    havocPosition(context_);
    tell(context_, MoveKind::Unmodelled, start);
    interpretation_.unmodelled(word.code->meaning, word.span);
  }
  /// A cycle of a lathe ends where it starts.
  void roundTrip(std::string_view what, Span place) {
    tell(context_, MoveKind::Unmodelled, state_.position);
    interpretation_.unmodelled(what, place);
  }

  // ---- targets ----

  Truth axisWords() const {
    Truth any = interpretation_.truth(false);
    for (const Axis axis : kAllAxes)
      any = context_.either(any, present(letterOf(axis)));
    return context_.dialect().machine == MachineKind::Turning ? context_.either(any, present('H')) : any;
  }
  /// An arc whose end point is not written ends where it starts.
  Truth isFullCircle() {
    const Truth centre = context_.either(present('I'), context_.either(present('J'), present('K')));
    const Truth arc = interpretation_.both(centre, isArc());
    const std::optional<Plane> plane = planeOf(context_);
    if (!plane || !interpretation_.mayBe(arc))
      return arc;
    const Truth inPlane = context_.either(present(plane->firstCentre), present(plane->secondCentre));
    if (interpretation_.mayBe(interpretation_.both(arc, interpretation_.negation(inPlane))))
      interpretation_.unmodelled("a centre word outside the plane of the arc", context_.place());
    return interpretation_.both(arc, context_.either(inPlane, context_.maybeNot()));
  }
  /// A distance to the centre on the axis that is not of the plane: a control may refuse it, or pass over it.
  Truth centreBeside(const Plane &plane) const {
    Truth beside = interpretation_.truth(false);
    for (const char letter : {'I', 'J', 'K'})
      if (letter != plane.firstCentre && letter != plane.secondCentre)
        beside = context_.either(beside, present(letter));
    return beside;
  }
  Truth cycleActive() {
    const Truth none = interpretation_.truth(false);
    const auto group = context_.modes.groupOf(ModalKind::Cycle);
    if (!group)
      return none;
    return interpretation_.isOneOf(state_.codes[*group], context_.modes.maskOf(ModalKind::Cycle, kDrillingCycles));
  }

  /// `holds`: whether this is what the block does.
  void plain(Truth holds) {
    const Truth turning = context_.inForce(ModalKind::Motion, {CodeAction::TurningCycle}, interpretation_.truth(false));
    if (context_.certain(turning))
      return roundTrip("a repeated turning cycle", context_.place());
    const Point start = state_.position;
    state_.position = targetOf(context_, words_);
    if (hasCommaWord("A")) {
      interpretation_.unmodelled("a coordinate given by an angle", context_.place());
      havocPosition(context_);
    }
    const Truth arc = isArc();
    if (context_.certain(arc) && isLineForWantOfCentre())
      return tell(context_, hasOtherWay() ? MoveKind::Unmodelled : MoveKind::Feed, start);
    if (interpretation_.mayBe(arc))
      followArc(start, arc, interpretation_.both(arc, holds));
    if (!context_.certain(arc) && interpretation_.wantsMoves())
      tellLine(start);
    if (interpretation_.mayBe(turning))
      for (std::size_t axis = 0; axis < kAxisCount; ++axis)
        state_.position[axis] = interpretation_.select(turning, start[axis], state_.position[axis]);
  }
  Truth isArc() {
    return context_.inForce(ModalKind::Motion, {CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise},
                            interpretation_.truth(false));
  }
  bool isLineForWantOfCentre() const { // with parameter 3403#5 (CIR) at 0
    const auto isWritten = [&](char letter) { return words_.find(letter) != nullptr; };
    return context_.dialect().switches.cir == Switch::Off && std::ranges::none_of(std::string_view("IJKR"), isWritten);
  }
  void tellLine(const Point &start) {
    const auto isMotion = [&](CodeAction action) {
      return context_.certain(context_.inForce(ModalKind::Motion, {action}, interpretation_.truth(false)));
    };
    const MoveKind kind = hasOtherWay() || hasLatheCorner()                              ? MoveKind::Unmodelled
                          : isMotion(CodeAction::Rapid)                                  ? MoveKind::Rapid
                          : isMotion(CodeAction::Linear) || isMotion(CodeAction::Thread) ? MoveKind::Feed
                                                                                         : MoveKind::Unmodelled;
    tell(context_, kind, start);
  }
  /// Corners that are rounded or chamfered, dimensions given by an angle, single direction positioning (G60).
  bool hasOtherWay() const {
    return words_.has(CodeAction::OtherCurve) || hasCommaWord() || isOpenTarget(context_, words_);
  }
  /// The same corners and angles, as lines of a lathe have them.
  bool hasLatheCorner() const {
    const auto isWritten = [&](char letter) { return words_.find(letter) != nullptr; };
    return context_.dialect().machine == MachineKind::Turning &&
           (isWritten('R') || isWritten('I') || isWritten('K') || isWritten('A') || isWritten('C'));
  }
  bool hasCommaWord(std::string_view letters = {}) const {
    for (const Word &word : context_.tree().wordsOf(context_.block))
      if (word.has(Word::kComma) && (letters.empty() || letters.find(word.address()) != std::string_view::npos))
        return true;
    return false;
  }

  // ---- arcs ----

  struct Arc {
    Plane plane;
    Value first, second; // centre
    Truth byRadius;
    Truth unknown; // only a distance beside the plane
  };
  void followArc(const Point &start, Truth arc, Truth follows) {
    const std::optional<Plane> plane = planeOf(context_);
    if (!plane || interpretation_.mayBe(otherGeometry(context_))) { // only the end point is known
      alarmsOfUnknownPlane(follows);
      if (context_.certain(arc))
        tell(context_, MoveKind::Unmodelled, start);
      return;
    }
    closeCircle(*plane, start);
    const Truth byRadius = present('R');
    const Truth byCentre = context_.either(present(plane->firstCentre), present(plane->secondCentre));
    const Truth without = interpretation_.negation(context_.either(byRadius, byCentre));
    const Truth beside = centreBeside(*plane);
    interpretation_.alarm(interpretation_.both(interpretation_.both(follows, without),
                                               context_.either(interpretation_.negation(beside), context_.maybeNot())),
                          {AlarmKind::ArcWithoutCentre, context_.place()});
    const auto [first, second] = centreOf(*plane, start);
    const CircleMapping<R> mapping = circleMappingOf(context_, *plane);
    alarmsOfRadius(*plane, start, mapping, interpretation_.both(follows, byRadius));
    const Truth differs = radiiDiffer(*plane, start, first, second);
    const Truth isCircle = interpretation_.both(interpretation_.both(mapping.staysCircle, byCentre),
                                                interpretation_.truth(turnsOf().has_value()));
    const Truth mayDiffer =
        context_.either(interpretation_.both(isCircle, differs),
                        interpretation_.both(interpretation_.negation(isCircle), context_.maybeNot()));
    interpretation_.alarm(
        interpretation_.both(interpretation_.both(follows, interpretation_.negation(byRadius)), mayDiffer),
        {AlarmKind::ArcRadius, context_.place()});
    if (interpretation_.wantsMoves() && context_.certain(arc))
      tellArc(start, {*plane, first, second, byRadius, interpretation_.both(without, beside)}, mapping);
  }
  /// No circle of that radius goes through both ends.  All controls stop; how much too small the radius may be is a
  /// parameter of most, and one that is accepted makes half a circle.
  void alarmsOfRadius(const Plane &plane, const Point &start, const CircleMapping<R> &mapping, Truth follows) {
    const auto *entry = words_.find('R');
    if (!entry || !interpretation_.mayBe(follows))
      return;
    const Value radius =
        interpretation_.function(FunctionKind::Abs, interpretation_.multiply(entry->value, mapping.scale));
    const auto [a, b] = chordOf(plane, start);
    const Value chordSquare = interpretation_.add(interpretation_.multiply(a, a), interpretation_.multiply(b, b));
    const Value halfSquare = interpretation_.divide(chordSquare, interpretation_.number(4));
    const auto isTooShort = [&](const Value &length) {
      return interpretation_.compare(Relation::Greater, halfSquare, interpretation_.multiply(length, length));
    };
    const Switches &switches = context_.dialect().switches;
    const Truth isShort =
        interpretation_.both(isTooShort(radius), context_.either(isTooShort(interpretation_.add(radius, tolerance())),
                                                                 context_.isOn(switches.shortArcStops)));
    const Truth isPoint = interpretation_.both(interpretation_.compare(Relation::Equal, chordSquare, context_.zero()),
                                               context_.isOn(switches.pointArcStops));
    const Truth asMapped = context_.either(mapping.staysCircle, context_.maybeNot());
    interpretation_.alarm(interpretation_.both(follows, interpretation_.both(asMapped, isShort)),
                          {AlarmKind::ArcTooShort, context_.place()});
    interpretation_.alarm(interpretation_.both(follows, isPoint), {AlarmKind::ArcWithoutLength, context_.place()});
  }
  /// From start to end, as radii are counted.
  std::pair<Value, Value> chordOf(const Plane &plane, const Point &start) {
    const auto along = [&](Axis axis) {
      return asRadius(axis, interpretation_.subtract(state_.at(axis), start[indexOf(axis)]));
    };
    return {along(plane.first), along(plane.second)};
  }
  /// Through the mappings and back a coordinate comes out a rounding error away, and a full circle would be none.
  void closeCircle(const Plane &plane, const Point &start) {
    constexpr double kSame = 1e-9;
    const auto isBack = [&](Axis axis) {
      const auto before = interpretation_.constantOf(start[indexOf(axis)]);
      const auto after = interpretation_.constantOf(state_.at(axis));
      return before && after && std::abs(*before - *after) < kSame;
    };
    if (!interpretation_.mayBe(state_.transformed) || !isBack(plane.first) || !isBack(plane.second))
      return;
    state_.at(plane.first) = start[indexOf(plane.first)];
    state_.at(plane.second) = start[indexOf(plane.second)];
  }
  void alarmsOfUnknownPlane(Truth arc) {
    const Truth byCentre = interpretation_.both(arc, interpretation_.negation(present('R')));
    const Truth anyDistance = context_.either(present('I'), context_.either(present('J'), present('K')));
    const Truth without = context_.either(interpretation_.negation(anyDistance), context_.maybeNot());
    interpretation_.alarm(interpretation_.both(byCentre, without), {AlarmKind::ArcWithoutCentre, context_.place()});
    const auto mayStop = [&](Truth when, AlarmKind kind) {
      interpretation_.alarm(interpretation_.both(when, context_.maybeNot()), {kind, context_.place()});
    };
    mayStop(byCentre, AlarmKind::ArcRadius);
    const Truth byRadius = interpretation_.both(arc, present('R'));
    mayStop(byRadius, AlarmKind::ArcTooShort);
    if (context_.dialect().switches.pointArcStops != Switch::Off)
      mayStop(byRadius, AlarmKind::ArcWithoutLength);
  }
  Truth present(char letter) const {
    const auto *entry = words_.find(letter);
    return entry ? entry->present : interpretation_.truth(false);
  }
  /// I, J, K are distances from the start point, mapped like those of the axes; absolute only where the control has
  /// that mode.
  std::pair<Value, Value> centreOf(const Plane &plane, const Point &start) {
    Point distance;
    distance.fill(context_.zero());
    distance[indexOf(plane.first)] = asCoordinate(plane.first, distanceWord(plane.firstCentre));
    distance[indexOf(plane.second)] = asCoordinate(plane.second, distanceWord(plane.secondCentre));
    const Point mapped = toWorkDistance(context_, distance);
    const auto centreOn = [&](Axis axis, char letter) {
      const Value fromStart = interpretation_.add(start[indexOf(axis)], mapped[indexOf(axis)]);
      if (!context_.behaviour().arcDistanceModes)
        return fromStart;
      const Truth absolute =
          context_.inForce(ModalKind::ArcDistance, {CodeAction::ArcAbsolute}, interpretation_.truth(false));
      return interpretation_.select(absolute, distanceWord(letter), fromStart);
    };
    return {centreOn(plane.first, plane.firstCentre), centreOn(plane.second, plane.secondCentre)};
  }
  Value distanceWord(char letter) {
    const auto *entry = words_.find(letter);
    return entry ? interpretation_.select(entry->present, entry->value, context_.zero()) : context_.zero();
  }
  /// On a lathe X is a diameter, I a radius.
  Value asCoordinate(Axis axis, const Value &length) {
    return axis == Axis::X && context_.dialect().machine == MachineKind::Turning
               ? interpretation_.multiply(length, interpretation_.number(2))
               : length;
  }
  Value asRadius(Axis axis, const Value &length) {
    return axis == Axis::X && context_.dialect().machine == MachineKind::Turning
               ? interpretation_.divide(length, interpretation_.number(2))
               : length;
  }
  Truth radiiDiffer(const Plane &plane, const Point &start, const Value &first, const Value &second) {
    const auto spoke = [&](const Point &point) -> std::array<Value, 2> {
      return {asRadius(plane.first, interpretation_.subtract(point[indexOf(plane.first)], first)),
              asRadius(plane.second, interpretation_.subtract(point[indexOf(plane.second)], second))};
    };
    return lengthsDiffer(interpretation_, spoke(start), spoke(state_.position), tolerance());
  }
  Value tolerance() {
    const Value metric = interpretation_.number(context_.behaviour().arcTolerance);
    return interpretation_.select(isMetric(context_), metric,
                                  interpretation_.number(context_.behaviour().arcTolerance / 25.4));
  }

  void tellArc(const Point &start, const Arc &arc, const CircleMapping<R> &mapping) {
    const std::optional<bool> clockwise = turnsClockwise(mapping.turnsOver);
    const std::optional<std::uint32_t> turns = turnsOf();
    if (!clockwise || !turns || !context_.certain(mapping.staysCircle) || interpretation_.mayBe(arc.unknown) ||
        hasOtherWay()) {
      if (!context_.certain(mapping.staysCircle))
        interpretation_.unmodelled("an arc whose axes are scaled by different factors", context_.place());
      else if (!clockwise)
        interpretation_.unmodelled("an arc in an unknown direction", context_.place());
      else if (!turns)
        interpretation_.unmodelled("an arc with words for a spiral or for full turns", context_.place());
      return tell(context_, MoveKind::Unmodelled, start);
    }
    Move<Value> move;
    move.kind = *clockwise ? MoveKind::ArcClockwise : MoveKind::ArcCounterclockwise;
    move.start = start;
    move.end = state_.position;
    move.plane = arc.plane;
    const auto byRadius = centreFromRadius(arc.plane, start, *clockwise, mapping.scale);
    move.firstCentre = interpretation_.select(arc.byRadius, byRadius.first, arc.first);
    move.secondCentre = interpretation_.select(arc.byRadius, byRadius.second, arc.second);
    move.turns = *turns;
    move.feed = state_.word('F');
    if (context_.certain(arc.byRadius) && sameInPlane(arc.plane, start))
      move.kind = MoveKind::Feed; // no arc at all: 0 degrees
    tell(context_, std::move(move));
  }
  /// Seen in work coordinates; absent when it can be either.
  std::optional<bool> turnsClockwise(Truth turnsOver) {
    const Truth none = interpretation_.truth(false);
    const bool clockwise = context_.certain(context_.inForce(ModalKind::Motion, {CodeAction::ArcClockwise}, none));
    const bool counter = context_.certain(context_.inForce(ModalKind::Motion, {CodeAction::ArcCounterclockwise}, none));
    const bool over = context_.certain(turnsOver);
    if (clockwise == counter || (!over && interpretation_.mayBe(turnsOver)))
      return std::nullopt;
    return clockwise != over;
  }
  /// P turns of controls that count them; absent: not known, or the block has words of a spiral or of a cone.
  std::optional<std::uint32_t> turnsOf() {
    if (!context_.behaviour().arcDistanceModes) {
      const bool isOther = words_.find('L') || words_.find('Q') || words_.find('P');
      return isOther ? std::nullopt : std::optional<std::uint32_t>(1);
    }
    const auto *entry = words_.find('P');
    if (!entry)
      return 1;
    const std::optional<double> turns = interpretation_.constantOf(entry->value);
    if (!turns || *turns >= 1e6 || !context_.certain(entry->present))
      return std::nullopt;
    return *turns >= 1 ? static_cast<std::uint32_t>(*turns) : 1;
  }
  bool sameInPlane(const Plane &plane, const Point &start) {
    const auto same = [&](Axis axis) {
      return context_.certain(interpretation_.compare(Relation::Equal, start[indexOf(axis)], state_.at(axis)));
    };
    return same(plane.first) && same(plane.second);
  }
  /// The centre lies on the perpendicular through the middle of the chord; the sign of R chooses the longer arc.
  std::pair<Value, Value> centreFromRadius(const Plane &plane, const Point &start, bool clockwise, const Value &scale) {
    const Value zero = context_.zero();
    const auto *entry = words_.find('R');
    if (!entry)
      return {zero, zero};
    const Value radius = interpretation_.multiply(entry->value, scale);
    const Value two = interpretation_.number(2);
    const auto [a, b] = chordOf(plane, start);
    const Value chordSquare = interpretation_.add(interpretation_.multiply(a, a), interpretation_.multiply(b, b));
    const Value heightSquare = interpretation_.subtract(interpretation_.multiply(radius, radius),
                                                        interpretation_.divide(chordSquare, interpretation_.number(4)));
    const Truth negative = interpretation_.compare(Relation::Less, heightSquare, zero);
    const Value height =
        interpretation_.function(FunctionKind::Sqrt, interpretation_.select(negative, zero, heightSquare));
    const Truth noChord = interpretation_.compare(Relation::Equal, chordSquare, zero);
    const Value chord = interpretation_.function(
        FunctionKind::Sqrt, interpretation_.select(noChord, interpretation_.number(1), chordSquare));
    const Truth longArc = interpretation_.compare(Relation::Less, entry->value, zero);
    const Value side = interpretation_.select(longArc, interpretation_.number(clockwise ? 1 : -1),
                                              interpretation_.number(clockwise ? -1 : 1));
    const Value ratio = interpretation_.multiply(side, interpretation_.divide(height, chord));
    const auto from = [&](Axis axis, const Value &length) {
      return interpretation_.add(start[indexOf(axis)], asCoordinate(axis, length));
    };
    return {
        from(plane.first, interpretation_.subtract(interpretation_.divide(a, two), interpretation_.multiply(ratio, b))),
        from(plane.second, interpretation_.add(interpretation_.divide(b, two), interpretation_.multiply(ratio, a)))};
  }

  // ---- codes that are not modal ----

  void dwell() {
    if (!interpretation_.wantsMoves())
      return;
    Move<Value> move;
    move.kind = MoveKind::Dwell;
    move.start = move.end = state_.position;
    for (const char letter : {'X', 'U', 'P'})
      if (const auto *entry = words_.find(letter))
        move.feed = entry->value;
    interpretation_.move(move);
  }
  void machineMove() {
    const Point start = state_.position;
    const Truth incremental =
        context_.inForce(ModalKind::Distance, {CodeAction::Incremental}, interpretation_.truth(false));
    const MachineIncrement meaning = context_.behaviour().machineIncrement;
    if (meaning == MachineIncrement::Alarm)
      interpretation_.alarm(interpretation_.both(incremental, axisWords()),
                            {AlarmKind::MachineIncrement, context_.place()});
    for (const Axis axis : kAllAxes)
      if (const auto *entry = words_.find(letterOf(axis))) {
        Value &position = state_.at(axis);
        const Value absolute = interpretation_.subtract(entry->value, originOf(context_, axis));
        const Value increment = meaning == MachineIncrement::Distance
                                    ? interpretation_.add(position, entry->value)
                                    : interpretation_.either(position, interpretation_.anyNumber());
        const Value target = interpretation_.select(incremental, increment, absolute);
        position = interpretation_.select(entry->present, target, position);
      }
    if (meaning == MachineIncrement::NotFollowed && interpretation_.mayBe(incremental)) {
      interpretation_.unmodelled("G53 under G91", context_.place());
      return tell(context_, MoveKind::Unmodelled, start);
    }
    if (!context_.behaviour().machineMoveByMode)
      tell(context_, MoveKind::Rapid, start);
    else if (interpretation_.wantsMoves())
      tellLine(start);
  }
  /// By way of the programmed point to the reference position.
  void referenceReturn(const CodeWord &word) {
    const Point start = state_.position;
    const MoveKind kind = isOpenTarget(context_, words_) ? MoveKind::Unmodelled : MoveKind::Rapid;
    state_.position = targetOf(context_, words_);
    tell(context_, kind, start);
    const Point between = state_.position;
    const Truth all = interpretation_.both(interpretation_.truth(context_.behaviour().bareReferenceReturn),
                                           interpretation_.negation(axisWords()));
    for (const Axis axis : kAllAxes)
      if (const Truth homes = context_.either(present(letterOf(axis)), all); interpretation_.mayBe(homes))
        home(axis, homes, word);
    for (const auto &[letter, axis] : kTurningIncrements)
      if (const auto *entry = context_.dialect().machine == MachineKind::Turning ? words_.find(letter) : nullptr)
        home(axis, entry->present, word);
    const bool isKnown =
        word.code->action == CodeAction::ReferenceReturn || referenceRange(VariableRole::SecondReference);
    tell(context_, isKnown ? MoveKind::Rapid : MoveKind::Unmodelled, between);
  }
  /// G27: rapid to where the reference position should be.
  void referenceCheck() {
    const Point start = state_.position;
    state_.position = targetOf(context_, words_);
    tell(context_, MoveKind::Rapid, start);
  }
  void home(Axis axis, Truth present, const CodeWord &word) {
    Value &position = state_.at(axis);
    const Value reference = interpretation_.subtract(referencePosition(axis, word), originOf(context_, axis));
    position = interpretation_.select(present, reference, position);
  }
  /// Machine coordinate; that of G28 is the machine's zero where no variable says otherwise.
  Value referencePosition(Axis axis, const CodeWord &word) {
    const bool isFirst = word.code->action == CodeAction::ReferenceReturn;
    if (const VariableRange *range = referenceRange(isFirst ? VariableRole::Reference : VariableRole::SecondReference))
      return offsetVariable(context_, range->first + static_cast<std::uint32_t>(indexOf(axis)));
    if (isFirst)
      return context_.zero();
    interpretation_.unmodelled("the second reference position", word.span);
    return interpretation_.anyNumber();
  }
  const VariableRange *referenceRange(VariableRole role) const { return rangeWithRole(context_.dialect(), role); }
  void storeReference(VariableRole role) {
    const VariableRange *range = referenceRange(role);
    for (const Axis axis : kAllAxes)
      if (range)
        state_.variables.set(range->first + static_cast<std::uint32_t>(indexOf(axis)),
                             interpretation_.add(state_.at(axis), originOf(context_, axis)));
  }
  /// G31: the movement ends at the target, or wherever the signal comes; #5061.. say where.
  void skip() {
    const Point start = state_.position;
    const Point target = targetOf(context_, words_);
    for (std::size_t axis = 0; axis < kAxisCount; ++axis)
      if (words_.find(kAxisLetters[axis]) || interpretation_.mayBe(state_.transformed))
        state_.position[axis] = interpretation_.between(start[axis], target[axis]);
    for (const VariableRange &range : context_.dialect().variables)
      if (range.role == VariableRole::SkipPosition)
        for (std::uint32_t axis = 0; axis < kAxisCount && range.first + axis <= range.last; ++axis)
          state_.variables.set(range.first + axis, state_.position[axis]);
    tell(context_, MoveKind::Probe, start);
  }

  StepContext<R> &context_;
  R &interpretation_;
  MachineState<R> &state_;
  const ExecutedWords<R> &words_;
};

} // namespace detail

template <ValueAlgebra R> void applyMotion(StepContext<R> &context, const ExecutedWords<R> &words) {
  detail::Motion<R>(context, words).run();
}

} // namespace feedhold
