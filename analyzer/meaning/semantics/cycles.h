// Cycles: the canned cycles G73 to G89 of machining centres, hole by hole.
//
// Motion: to the hole at the present level, to the R level, down to the bottom as the cycle says, back to the R level
// (G99) or to the level at which the cycle began (G98).  Source: FANUC operator's manual, "canned cycle"; for LinuxCNC
// its "G code reference", whose rows in Behaviour differ.
#pragma once

#include "meaning/semantics/targets.h"

#include <utility>

namespace feedhold {

inline constexpr std::initializer_list<CodeAction> kDrillingCycles = {
    CodeAction::CycleDrill,    CodeAction::CycleDwell,      CodeAction::CyclePeck,      CodeAction::CycleChipBreak,
    CodeAction::CycleTap,      CodeAction::CycleTapLeft,    CodeAction::CycleBore,      CodeAction::CycleBoreStop,
    CodeAction::CycleBackBore, CodeAction::CycleBoreManual, CodeAction::CycleBoreDwell, CodeAction::CycleFineBore};

inline bool isDrillingCycle(CodeAction action) {
  return std::find(kDrillingCycles.begin(), kDrillingCycles.end(), action) != kDrillingCycles.end();
}

/// A block with axis words while a cycle is active.
template <ValueAlgebra R> void runCycle(StepContext<R> &context, const ExecutedWords<R> &words);

/// The levels of a cycle may be those that are known, or any.
template <ValueAlgebra R> void openCycleLevels(StepContext<R> &context) {
  auto &cycle = context.state.cycle;
  for (auto *level : {&cycle.bottom, &cycle.retract, &cycle.initial, &cycle.peck, &cycle.dwell})
    *level = context.interpretation.either(*level, context.interpretation.anything());
}

/// Takes over the levels of a block while a cycle may be active.
template <ValueAlgebra R> void learnCycleLevels(StepContext<R> &context, const ExecutedWords<R> &words);

/// No cycle is active any more.
template <ValueAlgebra R> void endCycle(StepContext<R> &context) {
  const auto vacant = context.interpretation.vacant();
  context.state.cycle = {vacant, vacant, vacant, vacant, vacant};
}

/// What the first block of a multiple cycle of a lathe says is kept in the levels of the cycle, with the cycle itself
/// in `retract`: a number that no level has.
template <ValueAlgebra R> typename R::Value firstBlockOf(StepContext<R> &context, CodeAction action) {
  constexpr double kNoLevel = -1e12;
  return context.interpretation.number(kNoLevel - static_cast<double>(action));
}

/// A G code of a lathe.  X, Z and R of a single cycle last while such blocks follow one another; what the first block
/// of a multiple cycle says, which its second looks for, up to another code.
template <ValueAlgebra R> void enterTurningCode(StepContext<R> &context, CodeAction action) {
  auto &cycle = context.state.cycle;
  R &interpretation = context.interpretation;
  if (!isTurningCycle(action))
    return endCycle(context);
  if (isSingleTurningCycle(action)) {
    // A first block, or a drilling cycle, has left other things in the levels.
    const auto isSingle =
        interpretation.both(interpretation.isVacant(cycle.initial), interpretation.isVacant(cycle.dwell));
    return context.certain(isSingle) ? void() : endCycle(context);
  }
  const auto isGiven = interpretation.negation(interpretation.isVacant(cycle.retract));
  const auto isOwn =
      interpretation.compare(Relation::Equal, interpretation.asNumber(cycle.retract), firstBlockOf(context, action));
  if (!context.certain(interpretation.both(isGiven, isOwn)))
    endCycle(context);
}

// ---- implementation -----------------------------------------------------------------------------------------------

namespace detail {

/// Of a block that begins a cycle; `isBare`: its depth or its R level has never been given.
template <ValueAlgebra R>
void alarmOfBareCycle(StepContext<R> &context, const ExecutedWords<R> &words, typename R::Truth isBare) {
  R &interpretation = context.interpretation;
  const auto begins = [](const CodeWord &word) { return isDrillingCycle(word.code->action); };
  if (std::any_of(words.codes.begin(), words.codes.end(), begins))
    interpretation.alarm(interpretation.both(isBare, context.isOn(&Switches::bareCycleStops)),
                         {AlarmKind::CycleWithoutLevel, context.place()});
}

template <ValueAlgebra R> class DrillingCycle {
public:
  using Value = typename R::Value;
  using Truth = typename R::Truth;
  using Point = std::array<Value, kAxisCount>;

  DrillingCycle(StepContext<R> &context, const ExecutedWords<R> &words, Plane plane)
      : context_(context), interpretation_(context.interpretation), state_(context.state), cycle_(context.state.cycle),
        words_(words), plane_(plane) {}

  void run() {
    if (interpretation_.mayBe(isNotExecuted()))
      return drillSomehow();
    learnLevels();
    alarmOfBareCycle(
        context_, words_,
        context_.either(interpretation_.isVacant(cycle_.bottom), interpretation_.isVacant(cycle_.retract)));
    settleLevels();
    const std::optional<double> repeats = repeatCount();
    if (!repeats)
      return drillUnknownTimes();
    if (*repeats < 0.5) // K0 only stores the data
      return forgetUndrilled();
    clearFirst();
    for (double done = 0; done + 0.5 < *repeats; ++done)
      drill();
  }

  void learnLevels() {
    Value &level = state_.at(plane_.normal);
    cycle_.initial = interpretation_.select(interpretation_.isVacant(cycle_.initial), level,
                                            interpretation_.asNumber(cycle_.initial));
    const Truth absolute = isAbsolute(context_);
    const Value before = interpretation_.asNumber(cycle_.retract);
    if (const auto *entry = words_.find('R'))
      learn(cycle_.retract, *entry, absolute, cycle_.initial);
    if (context_.behaviour().cycleKeepsDepth) // below the R level
      cycle_.bottom = interpretation_.select(
          context_.either(absolute, interpretation_.isVacant(cycle_.bottom)), cycle_.bottom,
          interpretation_.add(interpretation_.asNumber(cycle_.bottom),
                              interpretation_.subtract(interpretation_.asNumber(cycle_.retract), before)));
    if (const auto *entry = words_.find(letterOf(plane_.normal)))
      learn(cycle_.bottom, *entry, absolute, interpretation_.asNumber(cycle_.retract));
    for (const auto &[letter, kept] : {std::pair{'Q', &cycle_.peck}, std::pair{'P', &cycle_.dwell}})
      if (const auto *entry = words_.find(letter))
        *kept = interpretation_.select(entry->present, entry->value, *kept);
  }

private:
  enum class Kind { Straight, FeedBack, OutSomehow, Peck, ChipBreak, NotFollowed };
  static constexpr double kMostRepeats = 9999;
  static constexpr double kMostFollowed = 64; // of an interpretation that only needs the end point

  /// Haas drills in G17 only, and its manual does not say which levels of a cycle G51 scales.
  Truth isNotExecuted() {
    const Behaviour &behaviour = context_.behaviour();
    Truth open = interpretation_.truth(behaviour.cyclesNeedXY && plane_.normal != Axis::Z);
    if (!behaviour.cyclesAreScaled)
      open = context_.either(open, isScaled());
    return open;
  }
  Truth isScaled() {
    const Value &factor = state_.transform.scale[indexOf(plane_.normal)];
    return interpretation_.negation(interpretation_.compare(Relation::Equal, factor, interpretation_.number(1)));
  }
  void drillSomehow() {
    learnLevels();
    const Point start = state_.position;
    havocPosition(context_);
    tell(context_, MoveKind::Unmodelled, start);
    openCycleLevels(context_);
    interpretation_.unmodelled("a canned cycle under scaling, or in another plane", context_.place());
  }
  /// How deep a cycle goes that was never told, no manual says: a run stays where it is.
  void settleLevels() {
    const auto settled = [&](const Value &level, const Value &usual) {
      const Truth open = interpretation_.isVacant(level);
      const Value given = interpretation_.asNumber(level);
      return interpretation_.mayBe(open)
                 ? interpretation_.select(open, interpretation_.either(usual, interpretation_.anyNumber()), given)
                 : given;
    };
    retract_ = settled(cycle_.retract, interpretation_.asNumber(cycle_.initial));
    bottom_ = settled(cycle_.bottom, retract_);
  }
  /// With G91 the level is a distance from `base`.
  void learn(Value &level, const typename ExecutedWords<R>::Entry &entry, Truth absolute, const Value &base) {
    const Value wanted =
        interpretation_.select(absolute, toWorkOn(context_, plane_.normal, entry.value),
                               interpretation_.add(base, toWorkDistanceOn(context_, plane_.normal, entry.value)));
    level = interpretation_.select(entry.present, wanted, level);
  }
  std::optional<double> repeatCount() {
    for (const char letter : {'L', 'K'}) {
      if (letter == 'K' && !context_.behaviour().repeatsByK)
        continue;
      if (const auto *entry = words_.find(letter)) {
        if (context_.certain(interpretation_.negation(entry->present)))
          continue;
        std::optional<double> count = interpretation_.constantOf(interpretation_.asNumber(entry->value));
        if (const std::optional<double> literal = literalOf(letter))
          count = literal;
        const double most = interpretation_.wantsMoves() ? kMostRepeats : kMostFollowed;
        return count && *count <= most && context_.certain(entry->present) ? count : std::nullopt;
      }
    }
    return 1;
  }
  /// As it is written: K is a length elsewhere, and a number without a point would be taken for increments.
  std::optional<double> literalOf(char letter) const {
    std::optional<double> literal;
    for (const Word &word : context_.tree().wordsOf(context_.block))
      if (word.address() == letter && word.isNumber())
        literal = word.number().toDouble();
    return literal;
  }
  void drillUnknownTimes() {
    const auto before = state_;
    forgetUndrilled();
    const auto notDrilled = std::exchange(state_, before);
    drill();
    if (!context_.certain(isAbsolute(context_))) {
      const Point first = state_.position;
      for (const Axis axis : {plane_.first, plane_.second})
        if (mayMove(context_, words_, axis))
          state_.at(axis) = interpretation_.anyNumber();
      forgetKeptWords(context_);
      tell(context_, MoveKind::Unmodelled, first);
    }
    interpretation_.join(state_, interpretation_.unknownTruth(), notDrilled);
  }

  /// The words led nowhere: the next block may take what it leaves out from them, or from where the tool is.
  void forgetUndrilled() {
    if (namesPlane(words_, plane_))
      forgetKeptWords(context_);
  }

  const Value &retractLevel() const { return retract_; }
  const Value &bottomLevel() const { return bottom_; }
  Value returnLevel() {
    // Back boring comes back to the initial level, whichever level is asked for.
    const Truth toInitial = context_.either(
        context_.inForce(ModalKind::ReturnLevel, {CodeAction::ReturnToInitial}, interpretation_.truth(true)),
        context_.inForce(ModalKind::Cycle, {CodeAction::CycleBackBore}, interpretation_.truth(false)));
    const Value initial =
        context_.behaviour().cycleClearsFirst ? higher(cycle_.initial, retractLevel()) : cycle_.initial;
    return interpretation_.select(toInitial, initial, retractLevel());
  }

  /// A cycle that begins below its R level goes up to it before anything else.
  void clearFirst() {
    if (!context_.behaviour().cycleClearsFirst)
      return;
    const Truth below = interpretation_.compare(Relation::Less, cycle_.initial, retractLevel());
    if (interpretation_.mayBe(below))
      go(MoveKind::Rapid, interpretation_.select(below, retractLevel(), state_.at(plane_.normal)));
  }
  /// The level at which the tool goes from hole to hole.
  Value travelLevel() {
    const Value &present = state_.at(plane_.normal);
    if (!context_.behaviour().cycleClearsFirst)
      return present;
    return higher(present, higher(retractLevel(), returnLevel()));
  }
  Value higher(const Value &a, const Value &b) {
    return interpretation_.select(interpretation_.compare(Relation::Less, a, b), b, a);
  }

  void drill() {
    const Point start = state_.position;
    Ends<R> ends = endsOf(context_, words_);
    ends.work[indexOf(plane_.normal)] = travelLevel();
    goTo(context_, words_, ends);
    tell(context_, isOpenTarget(context_, words_) ? MoveKind::Unmodelled : MoveKind::Rapid, start);
    if (const auto inForce = planeOf(context_); !inForce || inForce->normal != plane_.normal)
      forgetKeptWords(context_); // the axis of the hole is one of the plane
    const Kind kind = interpretation_.wantsMoves() ? kindOf() : Kind::Straight;
    if (kind == Kind::NotFollowed) {
      interpretation_.unmodelled("the tool path of this boring cycle", context_.place());
      const Point hole = state_.position;
      state_.at(plane_.normal) = returnLevel();
      return tell(context_, MoveKind::Unmodelled, hole);
    }
    go(MoveKind::Rapid, retractLevel());
    if (interpretation_.wantsMoves())
      stroke(kind);
    go(MoveKind::Rapid, returnLevel());
  }
  void go(MoveKind kind, const Value &level) {
    const Point start = state_.position;
    if (context_.certain(interpretation_.compare(Relation::Equal, start[indexOf(plane_.normal)], level)))
      return;
    state_.at(plane_.normal) = level;
    tell(context_, kind, start);
  }

  /// Down and, where the cycle feeds back, up to the R level.
  void stroke(Kind kind) {
    switch (kind) {
    case Kind::Straight: go(MoveKind::Feed, bottomLevel()); return dwell();
    case Kind::FeedBack:
      go(MoveKind::Feed, bottomLevel());
      dwell();
      return go(MoveKind::Feed, feedsToReturnLevel() ? returnLevel() : retractLevel());
    case Kind::OutSomehow:
      go(MoveKind::Feed, bottomLevel());
      dwell();
      return go(MoveKind::Unmodelled, returnLevel());
    case Kind::Peck: return pecks(retractLevel());
    case Kind::ChipBreak: return pecks(std::nullopt);
    case Kind::NotFollowed: return;
    }
  }
  bool feedsToReturnLevel() {
    return context_.behaviour().boringReturnsAtFeed &&
           isInForce({CodeAction::CycleBoreDwell, CodeAction::CycleTap, CodeAction::CycleTapLeft});
  }
  bool isInForce(std::initializer_list<CodeAction> actions) {
    return context_.certain(context_.inForce(ModalKind::Cycle, actions, interpretation_.truth(false)));
  }
  void dwell() {
    if (!context_.certain(interpretation_.negation(interpretation_.isVacant(cycle_.dwell))))
      return;
    Move<Value> move;
    move.kind = MoveKind::Dwell;
    move.start = move.end = state_.position;
    move.feed = cycle_.dwell;
    interpretation_.move(move);
  }
  Kind kindOf() {
    if (!context_.certain(interpretation_.negation(isReversed(context_, plane_.normal))))
      return Kind::NotFollowed; // whether a hole is drilled upwards then, no manual says
    if (isInForce({CodeAction::CyclePeck}))
      return Kind::Peck;
    if (isInForce({CodeAction::CycleChipBreak}))
      return Kind::ChipBreak;
    if (isInForce({CodeAction::CycleBore, CodeAction::CycleBoreDwell, CodeAction::CycleTap, CodeAction::CycleTapLeft}))
      return Kind::FeedBack;
    if (isInForce({CodeAction::CycleDrill, CodeAction::CycleDwell, CodeAction::CycleBoreStop}))
      return Kind::Straight;
    // The operator pulls the tool out; G76 shifts it off the wall before it goes up.
    if (isInForce({CodeAction::CycleBoreManual, CodeAction::CycleFineBore}))
      return Kind::OutSomehow;
    return Kind::NotFollowed;
  }
  /// G83 goes back to the R level after each peck, G73 only by the clearance.
  void pecks(std::optional<Value> backTo) {
    const std::optional<double> step = interpretation_.constantOf(interpretation_.asNumber(cycle_.peck));
    if (!step ||
        (*step > 0 && !(interpretation_.constantOf(retractLevel()) && interpretation_.constantOf(bottomLevel()))))
      unknownPecks();
    else
      knownPecks(*step, std::move(backTo));
    go(MoveKind::Feed, bottomLevel());
  }
  /// Each rapid movement leads over part of the way from the R level to some depth, and each feed over part of the
  /// rest.
  void unknownPecks() {
    go(MoveKind::Feed, bottomLevel());
    go(MoveKind::Rapid, retractLevel());
    go(MoveKind::Rapid, interpretation_.between(retractLevel(), bottomLevel()));
  }
  void knownPecks(double depth, std::optional<Value> backTo) {
    const std::optional<double> top = interpretation_.constantOf(retractLevel());
    const std::optional<double> bottom = interpretation_.constantOf(bottomLevel());
    if (!(depth > 0) || !top || !bottom)
      return; // in one go
    if ((*top - *bottom) / depth >= kMostRepeats)
      return unknownPecks();
    const bool metric = context_.certain(isMetric(context_));
    const double clearance = context_.behaviour().peckClearance / (metric ? 1 : 25.4);
    for (int peck = 1; *top - peck * depth > *bottom; ++peck) {
      const double level = *top - peck * depth;
      go(MoveKind::Feed, interpretation_.number(level));
      if (backTo)
        go(MoveKind::Rapid, *backTo);
      go(MoveKind::Rapid, interpretation_.number(std::min(level + clearance, *top)));
    }
  }

  StepContext<R> &context_;
  R &interpretation_;
  MachineState<R> &state_;
  CycleState<Value> &cycle_;
  const ExecutedWords<R> &words_;
  Plane plane_;
  Value retract_{};
  Value bottom_{};
};

/// Along the normal of the plane, or always along Z: parameter 5101#0 of FANUC controls.
template <ValueAlgebra R> void drillAlong(StepContext<R> &context, const ExecutedWords<R> &words, const Plane &plane) {
  R &interpretation = context.interpretation;
  const auto byPlane = context.isOn(&Switches::fxy);
  if (plane.normal == Axis::Z || context.certain(byPlane))
    return DrillingCycle<R>(context, words, plane).run();
  if (!interpretation.mayBe(byPlane))
    return DrillingCycle<R>(context, words, kPlaneXY).run();
  auto before = context.state;
  DrillingCycle<R>(context, words, plane).run();
  std::swap(context.state, before);
  DrillingCycle<R>(context, words, kPlaneXY).run();
  interpretation.join(context.state, byPlane, before);
}

} // namespace detail

namespace detail {

/// Whether the words of the block lack the depth, in whichever plane is in force.
template <ValueAlgebra R> typename R::Truth lacksDepth(const StepContext<R> &context, const ExecutedWords<R> &words) {
  R &interpretation = context.interpretation;
  const auto lacks = [&](Axis normal) {
    return interpretation.negation(words.present(interpretation, letterOf(normal)));
  };
  auto inPlane = interpretation.truth(false);
  auto inSome = interpretation.truth(false);
  for (const auto &[action, plane] : kPlanes) {
    const auto inForce = context.inForce(ModalKind::Plane, {action}, interpretation.truth(false));
    inPlane = context.either(inPlane, interpretation.both(inForce, lacks(plane.normal)));
    inSome = context.either(inSome, lacks(plane.normal));
  }
  const auto mayLack = interpretation.both(inSome, context.maybeNot()); // its normal may be U, V or W
  inPlane = context.either(inPlane, interpretation.both(inOtherPlane(context), mayLack));
  const auto byPlane = context.isOn(&Switches::fxy);
  const auto alongZ = interpretation.both(interpretation.negation(byPlane), lacks(Axis::Z));
  return context.either(interpretation.both(byPlane, inPlane), alongZ);
}

/// Of the levels it is known whether they were given.
template <ValueAlgebra R> void drillAlongAny(StepContext<R> &context, const ExecutedWords<R> &words) {
  R &interpretation = context.interpretation;
  auto &cycle = context.state.cycle;
  const auto withoutDepth = interpretation.both(interpretation.isVacant(cycle.bottom), lacksDepth(context, words));
  const auto withoutLevel = interpretation.both(interpretation.isVacant(cycle.retract),
                                                interpretation.negation(words.present(interpretation, 'R')));
  alarmOfBareCycle(context, words, context.either(withoutDepth, withoutLevel));
  const auto level = [&](typename R::Truth isMissing) {
    return interpretation.select(isMissing, interpretation.vacant(), interpretation.anyNumber());
  };
  const auto any = interpretation.anything();
  cycle = {.bottom = level(withoutDepth), .retract = level(withoutLevel), .initial = any, .peck = any, .dwell = any};
}

} // namespace detail

template <ValueAlgebra R> void learnCycleLevels(StepContext<R> &context, const ExecutedWords<R> &words) {
  const std::optional<Plane> plane = planeOf(context);
  if (plane && (plane->normal == Axis::Z || context.certain(context.isOn(&Switches::fxy))))
    return detail::DrillingCycle<R>(context, words, *plane).learnLevels();
  detail::drillAlongAny(context, words);
}

template <ValueAlgebra R> void runCycle(StepContext<R> &context, const ExecutedWords<R> &words) {
  const std::optional<Plane> plane = planeOf(context);
  if (plane)
    return detail::drillAlong(context, words, *plane);
  detail::drillAlongAny(context, words);
  const auto start = context.state.position;
  havocPosition(context);
  tell(context, MoveKind::Unmodelled, start);
  context.interpretation.unmodelled("a canned cycle in an unknown plane", context.place());
}

} // namespace feedhold
