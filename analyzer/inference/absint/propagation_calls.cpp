// Calls: entering the programs that a block calls, or that a modal call calls after a movement.
#include "inference/absint/propagation.h"

namespace feedhold {

namespace {

constexpr double kMostUnrolled = 4;
constexpr std::size_t kMostParts = 200; // that a computed M97 may enter: each is gone through to the end
constexpr int kMostWalksAgain = 1000;   // of programs that find the same in several calls

} // namespace

bool Propagation::call(NodeId node, const CallProgram &calling, AbstractState &state) {
  AbstractContext context = contextAt(node, state);
  const CallRequest<AbstractInterpretation> request = prepareCall(context, calling.call);
  if (interpretation_.stopped())
    return false;
  if (phase_ == Phase::Walk)
    engine_.visitor_->called(placeOf(node), request);
  switch (request.action) {
  case CallAction::SetModal:
  case CallAction::EndModal: return true;
  case CallAction::Operation: interpretation_.havoc(state, "an operation of Macro A", context.place()); return true;
  case CallAction::Enter: break;
  }
  auto after = enter(node, request, std::move(state));
  if (!after)
    return false;
  state = std::move(*after);
  return true;
}

void Propagation::unknownCall(NodeId node, const CallRequest<AbstractInterpretation> &request, AbstractState &state,
                              std::string_view reason) {
  AbstractContext context = contextAt(node, state);
  havocCall(context, request, reason);
}

/// Of a program that is not among the files: like proofs, the analysis takes it to start and end no modal call.  Else
/// each movement behind it might call a program, and nothing would be known any more.
void Propagation::missingCall(NodeId node, const CallRequest<AbstractInterpretation> &request, AbstractState &state) {
  const Truth modal = state.modalCallsUnknown;
  unknownCall(node, request, state, "a program that was not supplied");
  state.modalCallsUnknown = modal;
}

std::optional<AbstractState> Propagation::enter(NodeId node, const CallRequest<AbstractInterpretation> &request,
                                                AbstractState state) {
  if (!request.callee) {
    const Span place = contextAt(node, state).place();
    interpretation_.alarm(Truth::Maybe, {missingAlarm(request), place});
    if (!request.possible.empty())
      interpretation_.alarm(Truth::Maybe,
                            {request.freshLocals ? AlarmKind::MacroNesting : AlarmKind::SubprogramNesting, place});
    if (request.isLocal && request.possible.size() > kMostParts && !engine_.gaveUp_)
      engine_.gaveUp_ = "a computed local call may enter too many parts of its program";
    engine_.unmodelledEntries_.insert(request.possible.begin(), request.possible.end());
    if (!request.possible.empty())
      return enterUnmodelled(node, request, std::move(state));
    missingCall(node, request, state);
    return state;
  }
  const auto times = repeatsOf(interpretation_, request);
  if (times && callsNothing(*times))
    return state;
  nestingAlarms(node, request, state);
  const bool tooDeep = engine_.open_.size() > facts_.file->dialect->limits.totalCallDepth;
  if (!tooDeep && !engine_.isOpen(*request.callee))
    return repeated(node, request, state);
  engine_.unmodelledEntries_.insert(*request.callee);
  return enterUnmodelled(node, request, std::move(state));
}

/// The program is gone through with nothing known; behind the call anything may have happened, and it may come back to
/// any number that some M99 P names.
std::optional<AbstractState>
Propagation::enterUnmodelled(NodeId node, const CallRequest<AbstractInterpretation> &request, AbstractState state) {
  state.transformed = Truth::Maybe; // its programs may turn or mirror
  unknownCall(node, request, state,
              request.callee ? "a program that calls itself" : "a program whose number is computed");
  const ReturnTargets &returns = engine_.programs_.returns();
  if (returns.any)
    returnTo(node, AbstractValue::anyNumber(), state);
  else
    for (const std::uint32_t number : returns.numbers)
      returnTo(node, interpretation_.number(static_cast<double>(number)), state);
  return state;
}

/// Whether the call is one too many.  The same program is gone through once for each depth, and what is known of it
/// holds at any depth: so the alarm is never certain.
void Propagation::nestingAlarms(NodeId node, const CallRequest<AbstractInterpretation> &request, AbstractState &state) {
  const Limits &limits = facts_.file->dialect->limits;
  const Span place = contextAt(node, state).place();
  if (!engine_.depthKnown_ || engine_.isOpen(*request.callee)) {
    if (request.freshLocals)
      interpretation_.alarm(Truth::Maybe, {AlarmKind::MacroNesting, place});
    interpretation_.alarm(Truth::Maybe, {AlarmKind::SubprogramNesting, place});
  } else if (const auto alarm = nestingAlarm(limits, engine_.depth_, request.freshLocals)) {
    interpretation_.alarm(Truth::Maybe, {*alarm, place});
  }
}

/// What comes back to the block behind the call.
std::optional<AbstractState> Propagation::repeated(NodeId node, const CallRequest<AbstractInterpretation> &request,
                                                   const AbstractState &before) {
  const auto times = repeatsOf(interpretation_, request);
  AbstractState inside = before;
  const CallSite site{placeOf(node), modal_, summary_.modalLimit};
  auto frame = enterCall(engine_.programs_, inside, request, site, times.value_or(1), interpretation_, NobodyAsks{});
  auto after = once(node, frame, std::move(inside));
  if (after && times != 1.0)
    after = calledAgain(node, frame, std::move(*after), times);
  if (after)
    leaveCall(engine_.programs_, *after, frame);
  if (times)
    return after;
  addTo(after, before); // none at all may be asked for
  return after;
}

/// From what the first repetition has left: what the last one leaves.
std::optional<AbstractState> Propagation::calledAgain(NodeId node, Frame<AbstractInterpretation> &frame,
                                                      AbstractState left, std::optional<double> times) {
  const auto next = [&](AbstractState begins) {
    repeatCall(engine_.programs_, begins, frame, interpretation_, NobodyAsks{});
    return once(node, frame, std::move(begins));
  };
  if (times && *times <= kMostUnrolled) {
    std::optional<AbstractState> after = std::move(left);
    while (after && isCalledAgain(frame))
      after = next(std::move(*after));
    return after;
  }
  for (int repetition = 0; !engine_.gaveUp_; ++repetition) {
    const auto more = next(left);
    if (!more || leq(interpretation_, *more, left))
      break;
    if (repetition < 2)
      joinInto(interpretation_, left, *more);
    else
      widenInto(interpretation_, left, *more, facts_.thresholds);
  }
  return left;
}

/// The state in which the program has returned, before it is left.  Returns to a sequence number leave it here.
std::optional<AbstractState> Propagation::once(NodeId node, const Frame<AbstractInterpretation> &frame,
                                               AbstractState state) {
  StepObserver *observer = interpretation_.observer();
  interpretation_.observe(nullptr);
  Summary &summary = engine_.summaryOf(frame.callee, state, frame.modalLimit);
  interpretation_.observe(observer);
  if (phase_ == Phase::Walk)
    walkInto(node, frame, summary);
  interpretation_.useDialect(*facts_.file->dialect);
  interpretation_.start();
  std::optional<AbstractState> behind;
  for (const Exit &exit : summary.exits) {
    AbstractState left = translated(interpretation_, exit.state, summary.entry, state);
    if (!exit.target) {
      addTo(behind, std::move(left));
      continue;
    }
    leaveCall(engine_.programs_, left, frame);
    returnTo(node, *exit.target, left);
  }
  return behind;
}

void Propagation::walkInto(NodeId node, const Frame<AbstractInterpretation> &frame, Summary &summary) {
  const CallDepth before = engine_.depth_;
  CallDepth inside = before.inside(frame.ownLocals);
  if (!engine_.depthKnown_)
    inside = {facts_.file->dialect->limits.totalCallDepth, 0};
  std::pair<CallDepth, std::vector<Place>> walk{inside, {}};
  if (engine_.visitor_->tellsCallsApart()) {
    walk.second = engine_.calls_;
    walk.second.push_back(placeOf(node));
  }
  if (summary.walkedAt.contains(walk))
    return;
  // Calls that double at each level would be told for ever.
  if (!walk.second.empty() && !summary.walkedAt.empty() && ++engine_.walkedAgain_ > kMostWalksAgain) {
    engine_.visitor_->leftOut(placeOf(node));
    return;
  }
  summary.walkedAt.insert(std::move(walk));
  engine_.depth_ = inside;
  engine_.calls_.push_back(placeOf(node));
  engine_.open_.push_back(frame.callee);
  interpretation_.useDialect(*engine_.programs_.file(frame.callee.file).dialect);
  Propagation(engine_, engine_.factsOf(frame.callee), summary, Phase::Walk).run();
  engine_.open_.pop_back();
  engine_.calls_.pop_back();
  engine_.depth_ = before;
  engine_.visitor_->resumed(placeOf(node), engine_.calls_);
}

void Propagation::addTo(std::optional<AbstractState> &all, AbstractState state) {
  if (all)
    joinInto(interpretation_, *all, state);
  else
    all = std::move(state);
}

/// M99 P: the program goes on at a sequence number of its own.
void Propagation::returnTo(NodeId node, const AbstractValue &target, const AbstractState &state) {
  const BlockId from = nodeAt(node).block;
  std::set<std::uint32_t> reached;
  for (const LabelNode &label : labelsOf(facts_.file->cfg, *facts_.file->model, from)) {
    if (!mayBeTrue(isEqual(target.number(), AbstractNumber::constant(static_cast<double>(label.number)))) ||
        !reached.insert(label.number).second)
      continue;
    if (!engine_.spend(Engine::kCostOfJump))
      return;
    const auto place = findLabel(facts_.file->cfg, *facts_.file->model, facts_.entry.program, label.number, from);
    if (!place)
      continue;
    if (phase_ == Phase::Ascend && !isHead(positionOf(*place))) {
      summary_.forcedHeads.insert(positionOf(*place));
      startAgain_ = true;
    }
    deliver(*place, AbstractState(state));
  }
  searchAlarms(node, target);
  interpretation_.start();
}

bool Propagation::modalCalls(NodeId node, AbstractState &state) {
  if (mayCallModally(interpretation_, state, summary_.modalLimit) == Truth::False)
    return true;
  AbstractContext context = contextAt(node, state);
  const Truth moves = movesAxis(context, words_);
  if (moves == Truth::False)
    return true;
  std::optional<AbstractState> before; // where it may be needed again
  if (moves == Truth::Maybe)
    before = state;
  loseCorner(context);
  if (mayBeTrue(state.modalCallsUnknown)) {
    CallRequest<AbstractInterpretation> unknown;
    unknown.freshLocals = true;
    unknown.possible = engine_.programs_.modalCallees();
    state = *enter(node, unknown, std::move(state)); // what is not known comes back
  } else {
    const std::size_t last = *modalCallOf(state, summary_.modalLimit);
    const CallRequest<AbstractInterpretation> request = prepareModalCall(context, state.modalCalls[last]);
    const auto outer = std::exchange(modal_, last);
    auto after = enter(node, request, std::move(state));
    modal_ = outer;
    if (!after) { // the block behind is reached only if nothing has moved
      if (before)
        state = std::move(*before);
      return before.has_value();
    }
    state = std::move(*after);
  }
  if (before)
    joinInto(interpretation_, state, *before);
  return true;
}

} // namespace feedhold
