// Motion: where the axis words of a block lead: lines, arcs, skip, machine coordinates, reference return, shifts.
#pragma once

#include "meaning/semantics/arcs.h"
#include "meaning/semantics/circle_pocket.h"
#include "meaning/semantics/corners.h"
#include "meaning/semantics/cycles.h"
#include "meaning/semantics/modes.h"
#include "meaning/semantics/offsets.h"
#include "meaning/semantics/turning_cycles.h"

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
    const bool isEmpty = words_.entries.empty() && words_.codes.empty();
    if (!isEmpty && interpretation_.mayBe(waitsForLine(context_)) && !endsCorner())
      loseCorner(context_,
                 ownWords() || !interpretation_.mayBe(axisWords()) ? CornerLost::Surely : CornerLost::Perhaps);
    const bool others = namesOtherAxes() || mayReturnOtherAxes();
    const bool keepsPlace = keepsWords(context_) && !leadsInPlane();
    const Point before = others || keepsPlace ? state_.position : Point{};
    act();
    if (keepsPlace)
      forgetKeptIfMoved(context_, before);
    if (const CodeWord *word = ownWords(); !word || isMovement(*word->code))
      settlePending(context_, words_);
    if ((!words_.entries.empty() || ownWords()) && interpretation_.mayBe(otherGeometry(context_))) {
      havocPosition(context_);
      noteAllMoved(otherGeometry(context_));
    }
    if (words_.mayTakeAxes)
      noteAllMoved(interpretation_.unknownTruth());
    if (others)
      noteOtherAxes(before);
    if (const CodeWord *change = words_.findCode(CodeAction::ToolChange);
        change && context_.behaviour().toolChangeReturnsZ)
      returnZ(*change);
  }

private:
  /// goTo says what is kept behind the movement of the block.
  bool leadsInPlane() {
    const std::optional<Plane> plane = planeOf(context_);
    return plane && !ownWords() && namesPlane(words_, *plane);
  }
  static bool isMovement(const Code &code) {
    constexpr std::array kMovements = {CodeAction::MachineMove, CodeAction::ReferenceReturn,
                                       CodeAction::SecondReference, CodeAction::ReferenceCheck, CodeAction::Skip};
    return isCirclePocket(code.action) ||
           std::find(kMovements.begin(), kMovements.end(), code.action) != kMovements.end();
  }
  /// One that regions do not describe.
  bool namesOther(Axis axis) const {
    if (!isBesideRegions(context_.dialect(), axis))
      return false;
    const bool isIncrement = axis == Axis::Y && incrementsByLetter(context_) && words_.find('V');
    return isIncrement || (!isLetterOfIncrement(axis) && words_.find(letterOf(axis)));
  }
  bool namesOtherAxes() const {
    return std::ranges::any_of(kAllAxes, [&](Axis axis) { return namesOther(axis); });
  }
  /// A reference return without axis words, of controls that return all axes then.
  Truth returnsAll() const {
    return interpretation_.both(interpretation_.truth(context_.behaviour().bareReferenceReturn),
                                interpretation_.negation(axisWords()));
  }
  bool mayReturnOtherAxes() const {
    return (words_.has(CodeAction::ReferenceReturn) || words_.has(CodeAction::SecondReference)) &&
           interpretation_.mayBe(returnsAll());
  }
  /// Such an axis turns the part, or moves it or the tool.
  void noteOtherAxes(const Point &before) {
    const bool mayReturn = mayReturnOtherAxes();
    for (const Axis axis : kAllAxes)
      if (namesOther(axis) || (mayReturn && isBesideRegions(context_.dialect(), axis)))
        noteMoved(axis, interpretation_.negation(
                            interpretation_.compare(Relation::Equal, before[indexOf(axis)], state_.at(axis))));
  }
  void noteMoved(Axis axis, const Truth &when) {
    Truth &moved = state_.axisMoved[indexOf(axis)];
    moved = context_.either(moved, when);
  }
  void noteAllMoved(const Truth &when) {
    for (const Axis axis : kAllAxes)
      if (isBesideRegions(context_.dialect(), axis))
        noteMoved(axis, when);
  }
  void act() {
    if (context_.behaviour().distanceModeByWord && words_.has(CodeAction::Absolute) &&
        words_.has(CodeAction::Incremental))
      return distanceModes();
    if (const CodeWord *word = ownWords())
      return isPocketBesideOthers() ? unmodelled(*word) : consume(*word);
    const Truth cycle = cycleActive();
    const Truth moves =
        context_.either(axisWords(), interpretation_.both(isFullCircle(), interpretation_.negation(cycle)));
    if (context_.certain(moves))
      return move(cycle, moves);
    if (mayChangeTaper()) {
      forgetCycle(context_);
      unmodelledCycle("a taper in a block without X and Z", context_.place());
    }
    changeLevelAlone(interpretation_.both(cycle, interpretation_.negation(moves)));
    if (!interpretation_.mayBe(moves))
      return;
    const auto before = state_;
    move(cycle, moves);
    interpretation_.join(state_, interpretation_.negation(moves), before);
  }
  /// `R-2.` under a canned cycle: FANUC drills in such a block, and the level stays; of others no manual says it.
  void changeLevelAlone(Truth isAlone) {
    const Truth changes = interpretation_.both(isAlone, present('R'));
    if (!interpretation_.mayBe(changes))
      return;
    const auto before = state_;
    drillOnLevel();
    interpretation_.join(state_, interpretation_.negation(changes), before);
  }
  /// `Z-20.` under a cycle that is executed in blocks with X or Y only (Haas), behind the block that begins it.
  bool passesOverDepth() const {
    const bool begins =
        std::ranges::any_of(words_.codes, [](const CodeWord &word) { return isDrillingCycle(word.code->action); });
    return context_.behaviour().cyclesNeedXY && !begins && words_.find('Z') && !words_.find('X') && !words_.find('Y');
  }
  void drillOnLevel() {
    const Point start = state_.position;
    if constexpr (requires { interpretation_.losePosition(); })
      interpretation_.losePosition();
    const CycleState<Value> before = state_.cycle;
    learnCycleLevels(context_, words_);
    auto &cycle = state_.cycle; // some controls may not take them over
    cycle.bottom = interpretation_.either(cycle.bottom, before.bottom);
    cycle.retract = interpretation_.either(cycle.retract, before.retract);
    forgetKeptWords(context_);
    const std::optional<Plane> plane = planeOf(context_);
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) // along whichever the cycle drills
      if (!plane || plane->normal == axis || axis == Axis::Z)
        state_.at(axis) = interpretation_.either(state_.at(axis), interpretation_.anyNumber());
    tell(context_, MoveKind::Unmodelled, start);
    interpretation_.unmodelled("a level of a canned cycle in a block without a position", context_.place());
  }
  void drill() {
    if (passesOverDepth())
      drillOnLevel();
    else
      runCycle(context_, words_);
  }
  /// R, I or K of a single cycle of a lathe that is in force.
  bool mayChangeTaper() {
    return (words_.find('R') || words_.find('I') || words_.find('K')) &&
           std::ranges::any_of(kSingleTurningCycles, [&](CodeAction action) {
             return interpretation_.mayBe(context_.inForce(ModalKind::Motion, {action}, interpretation_.truth(false)));
           });
  }
  void move(Truth cycle, Truth moves) {
    if (context_.certain(cycle))
      return drill();
    if (!interpretation_.mayBe(cycle))
      return plain(moves);
    auto drilled = state_; // either: both are followed, and what they leave is joined
    plain(interpretation_.both(moves, interpretation_.negation(cycle)));
    std::swap(state_, drilled);
    drill();
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
                                    CodeAction::SideCycle};
    return isTurningCycle(code.action) || isCirclePocket(code.action) || Offsets<R>::isOne(code) ||
           code.role == CodeRole::CoordinateShift ||
           std::find(kTaking.begin(), kTaking.end(), code.action) != kTaking.end();
  }
  /// Whose words those of the block are, no manual says.
  bool isPocketBesideOthers() const {
    const auto takes = [](const CodeWord &word) { return word.address == 'G' && takesWords(*word.code); };
    return std::ranges::any_of(words_.codes, [](const CodeWord &word) { return isCirclePocket(word.code->action); }) &&
           std::ranges::count_if(words_.codes, takes) > 1;
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
    else if (isTurningCycle(action))
      turningCycle(action, word.code->meaning, word.span);
    else if (isCirclePocket(action))
      circlePocket(word);
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
  void turningCycle(CodeAction action, std::string_view what, Span place) {
    forgetKeptWords(context_);
    if (runTurningCycle(context_, words_, action))
      return;
    for (const Axis axis : kAllAxes)
      if (namesOther(axis))
        state_.at(axis) = interpretation_.anyNumber();
    unmodelledCycle(what, place);
  }
  void circlePocket(const CodeWord &word) {
    if (!CirclePocket<R>(context_, words_, word.code->action).run())
      unmodelled(word);
  }
  void unmodelledCycle(std::string_view what, Span place) {
    tell(context_, MoveKind::Unmodelled, state_.position);
    interpretation_.unmodelled(what, place);
  }

  // ---- targets ----

  Truth axisWords() const {
    Truth any = interpretation_.truth(false);
    for (const Axis axis : kAllAxes)
      any = context_.either(any, present(letterOf(axis)));
    return incrementsByLetter(context_) ? context_.either(any, present('H')) : any;
  }
  Truth present(char letter) const { return words_.present(interpretation_, letter); }
  /// By its own letter, which on a lathe may be that of an increment.
  Truth isNamed(Axis axis) const {
    return isLetterOfIncrement(axis) ? interpretation_.truth(false) : present(letterOf(axis));
  }
  bool isLetterOfIncrement(Axis axis) const {
    return incrementsByLetter(context_) && (axis == Axis::U || axis == Axis::V || axis == Axis::W);
  }
  /// An arc whose end point is not written ends where it starts.  With a centre word beside the plane alone a control
  /// does nothing, or stops: then it counts as a circle, of which arcs.h raises the alarm.
  Truth isFullCircle() {
    const Truth centre = context_.either(present('I'), context_.either(present('J'), present('K')));
    const Truth arc = interpretation_.both(centre, isArc());
    const std::optional<Plane> plane = planeOf(context_);
    if (!plane || !interpretation_.mayBe(arc))
      return arc;
    const Truth inPlane = context_.either(present(plane->firstCentre), present(plane->secondCentre));
    if (interpretation_.mayBe(interpretation_.both(arc, interpretation_.negation(inPlane))))
      interpretation_.unmodelled("a centre word outside the plane of the arc", context_.place());
    const Truth stops = context_.isOn(&Switches::besideCentreStops);
    return interpretation_.both(arc, context_.either(inPlane, context_.either(stops, context_.maybeNot())));
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
    Truth turning = interpretation_.truth(false);
    for (const CodeAction action : kSingleTurningCycles) {
      const Truth isIt = context_.inForce(ModalKind::Motion, {action}, interpretation_.truth(false));
      if (context_.certain(isIt))
        return turningCycle(action, "a repeated turning cycle", context_.place());
      turning = context_.either(turning, isIt);
    }
    if (context_.certain(turning)) {
      forgetCycle(context_);
      return unmodelledCycle("a repeated turning cycle", context_.place());
    }
    const Point start = state_.position;
    goTo(context_, words_, endsOf(context_, words_));
    placeAxes();
    if (hasCommaWord("A")) {
      interpretation_.unmodelled("a coordinate given by an angle", context_.place());
      havocPosition(context_);
    }
    const Truth arc = isArc();
    if (context_.certain(arc) && isLineForWantOfCentre())
      return tell(context_, hasOtherWay() ? MoveKind::Unmodelled : MoveKind::Feed, start);
    if (interpretation_.mayBe(arc))
      Arcs<R>(context_, words_, hasOtherWay()).follow(start, arc, interpretation_.both(arc, holds));
    if (!context_.certain(arc) && !followCorners(start, holds) && interpretation_.wantsMoves())
      tellLine(start, context_.dialect().switches.lrp == Switch::On);
    if (!interpretation_.mayBe(turning))
      return;
    for (std::size_t axis = 0; axis < kAxisCount; ++axis)
      state_.position[axis] = interpretation_.select(turning, start[axis], state_.position[axis]);
    forgetCycle(context_);
    forgetKeptWords(context_);
  }
  // ---- corners (corners.h) ----

  bool isLineAtFeed() {
    return context_.certain(context_.inForce(ModalKind::Motion, {CodeAction::Linear}, interpretation_.truth(false))) &&
           !words_.has(CodeAction::OtherCurve) && !hasCommaWord("A") && !hasLatheCorner(false);
  }
  bool endsCorner() {
    return !ownWords() && context_.certain(axisWords()) && !interpretation_.mayBe(cycleActive()) && isLineAtFeed() &&
           (!hasCommaWord() || corners_.word()) && corners_.isLine();
  }
  /// Tells the line from `start`, or lets it wait.  False: it is none beside a corner that is followed.
  bool followCorners(const Point &start, Truth holds) {
    const bool waits = interpretation_.mayBe(waitsForLine(context_));
    if (!waits && !hasCommaWord())
      return false;
    const Word *word = corners_.word();
    if ((!waits && !word) || !context_.certain(holds) || !isLineAtFeed() || !corners_.isLine()) {
      loseCorner(context_, CornerLost::Perhaps);
      if (word)
        corners_.mayWait();
      return false;
    }
    const Point from = waits ? corners_.complete(start) : start;
    if (interpretation_.stopped())
      return true;
    if (word && corners_.wait(*word, from)) {
      if constexpr (requires { requires R::kAsksForKindsAlone; })
        tell(context_, MoveKind::Unmodelled, from);
      return true;
    }
    if (word)
      corners_.mayWait();
    tell(context_, hasCommaWord() ? MoveKind::Unmodelled : MoveKind::Feed, from);
    return true;
  }
  /// A run whose position was lost knows it again on the axes that a coordinate names.
  void placeAxes() {
    if constexpr (requires { interpretation_.placeAxis(Axis::X); }) {
      if (!context_.certain(isAbsolute(context_)) || interpretation_.mayBe(state_.transformed) ||
          isOpenTarget(context_, words_) || namesIncrements(context_, words_) ||
          interpretation_.mayBe(isPolar(context_)) || interpretation_.mayBe(otherGeometry(context_)))
        return;
      for (const Axis axis : kAllAxes)
        if (const auto *entry = words_.find(letterOf(axis)); entry && context_.certain(entry->present))
          interpretation_.placeAxis(axis);
    }
  }
  /// `G90 X30. G91 Y10.`: each code holds for the words behind it, whose order is not kept.
  void distanceModes() {
    const Point start = state_.position;
    havocPosition(context_);
    if (ownWords()) // which may set a zero point
      havocOrigins(context_);
    openCycleLevels(context_);
    tell(context_, MoveKind::Unmodelled, start);
    interpretation_.unmodelled("G90 and G91 in one block", context_.place());
  }
  Truth isArc() {
    return context_.inForce(ModalKind::Motion, {CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise},
                            interpretation_.truth(false));
  }
  bool isLineForWantOfCentre() const { // with parameter 3403#5 (CIR) at 0
    const auto isWritten = [&](char letter) { return words_.find(letter) != nullptr; };
    return context_.dialect().switches.cir == Switch::Off && std::ranges::none_of(std::string_view("IJKR"), isWritten);
  }
  void tellLine(const Point &start, bool isInterpolated) {
    const auto isMotion = [&](CodeAction action) {
      return context_.certain(context_.inForce(ModalKind::Motion, {action}, interpretation_.truth(false)));
    };
    const bool isRapid = isMotion(CodeAction::Rapid);
    const MoveKind kind = hasOtherWay() || hasLatheCorner(isRapid)                       ? MoveKind::Unmodelled
                          : isRapid                                                      ? MoveKind::Rapid
                          : isMotion(CodeAction::Linear) || isMotion(CodeAction::Thread) ? MoveKind::Feed
                                                                                         : MoveKind::Unmodelled;
    tell(context_, kind, start, kind == MoveKind::Rapid && isInterpolated);
  }
  /// Corners that are rounded or chamfered, dimensions given by an angle, single direction positioning (G60).
  bool hasOtherWay() const {
    return words_.has(CodeAction::OtherCurve) || hasCommaWord() || isOpenTarget(context_, words_);
  }
  /// The same corners and angles, as lines of a lathe have them; C of a rapid move is the axis.
  bool hasLatheCorner(bool isRapid) const {
    const auto isWritten = [&](char letter) { return words_.find(letter) != nullptr; };
    return hasTurret(context_) &&
           (isWritten('R') || isWritten('I') || isWritten('K') || isWritten('A') || (isWritten('C') && !isRapid));
  }
  bool hasCommaWord(std::string_view letters = {}) const {
    for (const Word &word : context_.tree().wordsOf(context_.block))
      if (word.has(Word::kComma) && (letters.empty() || letters.find(word.address()) != std::string_view::npos))
        return true;
    return false;
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
    if (namesIncrements(context_, words_)) {
      havocPosition(context_);
      interpretation_.unmodelled("G53 with increments", context_.place());
      return tell(context_, MoveKind::Unmodelled, start);
    }
    const Truth incremental =
        context_.inForce(ModalKind::Distance, {CodeAction::Incremental}, interpretation_.truth(false));
    const MachineIncrement meaning = context_.behaviour().machineIncrement;
    if (meaning == MachineIncrement::Alarm)
      interpretation_.alarm(interpretation_.both(incremental, axisWords()),
                            {AlarmKind::MachineIncrement, context_.place()});
    for (const Axis axis : kAllAxes)
      if (const auto *entry = words_.find(letterOf(axis))) {
        Value &position = state_.at(axis);
        const Value absolute = interpretation_.subtract(entry->value, machineOriginOf(context_, axis));
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
      tellLine(start, false); // whether G00 interpolates says nothing of G53
    mayCancelLength(context_, present('Z'));
  }
  /// By way of the programmed point to the reference position.
  void referenceReturn(const CodeWord &word) {
    const Point start = state_.position;
    const MoveKind kind = isOpenTarget(context_, words_) ? MoveKind::Unmodelled : MoveKind::Rapid;
    state_.position = targetOf(context_, words_);
    tell(context_, kind, start);
    const Point between = state_.position;
    const Truth all = returnsAll();
    for (const Axis axis : kAllAxes)
      if (const Truth homes = context_.either(isNamed(axis), all); interpretation_.mayBe(homes))
        home(axis, homes, word);
    for (const auto &[letter, axis] : kTurningIncrements)
      if (const auto *entry = incrementsByLetter(context_) ? words_.find(letter) : nullptr)
        home(axis, entry->present, word);
    const bool isKnown =
        word.code->action == CodeAction::ReferenceReturn || referenceRange(VariableRole::SecondReference);
    tell(context_, isKnown ? MoveKind::Rapid : MoveKind::Unmodelled, between);
    mayCancelLength(context_,
                    context_.either(context_.behaviour().referenceCancelsLength ? axisWords() : present('Z'), all));
  }
  /// M06 of controls that move Z to its reference position.
  void returnZ(const CodeWord &word) {
    const Point start = state_.position;
    home(Axis::Z, interpretation_.truth(true), word);
    mayCancelLength(context_, interpretation_.truth(true));
    if (interpretation_.mayBe(axisWords())) { // before the movement of its block or behind it
      state_.at(Axis::Z) = interpretation_.either(state_.at(Axis::Z), start[indexOf(Axis::Z)]);
      return tell(context_, MoveKind::Unmodelled, start);
    }
    tell(context_, MoveKind::Rapid, start);
  }
  /// G27: rapid to where the reference position should be.
  void referenceCheck() {
    const Point start = state_.position;
    const MoveKind kind = isOpenTarget(context_, words_) ? MoveKind::Unmodelled : MoveKind::Rapid;
    state_.position = targetOf(context_, words_);
    tell(context_, kind, start);
  }
  void home(Axis axis, Truth present, const CodeWord &word) {
    Value &position = state_.at(axis);
    const Value reference = interpretation_.subtract(referencePosition(axis, word), machineOriginOf(context_, axis));
    position = interpretation_.select(present, reference, position);
  }
  /// Machine coordinate; that of G28 is the machine's zero where no variable says otherwise.
  Value referencePosition(Axis axis, const CodeWord &word) {
    const bool isFirst = word.code->action != CodeAction::SecondReference;
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
                             interpretation_.add(state_.at(axis), machineOriginOf(context_, axis)));
  }
  /// G31: the movement ends at the target, or wherever the signal comes; #5061.. say where.
  void skip() {
    const Point start = state_.position;
    if constexpr (requires { interpretation_.readPosition(Axis::X); })
      for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
        interpretation_.readPosition(axis);
    const MoveKind kind = isOpenTarget(context_, words_) ? MoveKind::Unmodelled : MoveKind::Probe;
    const Point target = targetOf(context_, words_);
    if (const auto plane = planeOf(context_); !plane || namesPlane(words_, *plane))
      forgetKeptWords(context_); // where the signal comes at once, too
    interpretation_.beginSkip();
    for (const Axis axis : kAllAxes)
      if (mayMove(context_, words_, axis))
        state_.at(axis) = interpretation_.endOfSkip(start[indexOf(axis)], target[indexOf(axis)]);
    for (const auto &[letter, axis] : kTurningIncrements)
      if (incrementsByLetter(context_) && words_.find(letter))
        state_.at(axis) = interpretation_.endOfSkip(start[indexOf(axis)], target[indexOf(axis)]);
    for (const VariableRange &range : context_.dialect().variables)
      if (range.role == VariableRole::SkipPosition)
        for (std::uint32_t axis = 0; axis < kAxisCount && range.first + axis <= range.last; ++axis)
          state_.variables.set(range.first + axis, state_.position[axis]);
    tell(context_, kind, start);
  }

  StepContext<R> &context_;
  R &interpretation_;
  MachineState<R> &state_;
  const ExecutedWords<R> &words_;
  Corners<R> corners_{context_, words_};
};

} // namespace detail

template <ValueAlgebra R> void applyMotion(StepContext<R> &context, const ExecutedWords<R> &words) {
  detail::Motion<R>(context, words).run();
}

} // namespace feedhold
