// Calls: entering the programs that a block calls, or that a modal call calls after a movement.
#include "inference/absint/propagation.h"

namespace feedhold {

namespace {

constexpr double kMostUnrolled = 4;

using Entries = std::vector<VariableMap<AbstractValue>::Entry>;

bool isOwnName(const ProgramSet &programs, std::uint32_t variable) {
  return variable >= kFirstNamedVariable && !programs.isGlobalName(variable);
}

/// The named variables of the present level, which no called program sees, with a level of its own or by M98.
Entries ownNames(const ProgramSet &programs, const AbstractState &state) {
  Entries names;
  for (const auto &entry : state.variables.entries())
    if (isOwnName(programs, entry.first))
      names.push_back(entry);
  return names;
}
void putOwnNames(const ProgramSet &programs, AbstractState &state, const Entries &names) {
  std::erase_if(state.variables.entries(), [&](const auto &entry) { return isOwnName(programs, entry.first); });
  for (const auto &[variable, value] : names)
    state.variables.set(variable, value);
}

} // namespace

bool Propagation::call(NodeId node, const CallProgram &calling, AbstractState &state) {
  AbstractContext context = contextAt(node, state);
  const CallRequest<AbstractReading> request = prepareCall(context, calling.call);
  if (reading_.stopped())
    return false;
  if (pass_ == Pass::Walk)
    engine_.visitor_->called(placeOf(node), request);
  switch (request.action) {
  case CallAction::SetModal:
  case CallAction::EndModal:
    return true;
  case CallAction::Operation:
    reading_.havoc(state, "an operation of Macro A", context.place());
    return true;
  case CallAction::Enter:
    break;
  }
  auto after = enter(node, request, state);
  if (!after)
    return false;
  state = std::move(*after);
  return true;
}

/// A call of what is not known may do anything to what the called program sees.
void Propagation::unknownCall(NodeId node, const CallRequest<AbstractReading> &request, AbstractState &state,
                              std::string_view reason) {
  const auto locals = state.locals;
  const auto names = ownNames(engine_.programs_, state);
  const auto loops = state.enteredLoops;
  const auto counters = state.counters;
  reading_.havoc(state, reason, contextAt(node, state).place());
  if (request.freshLocals)
    state.locals = locals;
  putOwnNames(engine_.programs_, state, names);
  state.enteredLoops = loops;
  state.counters = counters;
}

std::optional<AbstractState> Propagation::enter(NodeId node, const CallRequest<AbstractReading> &request,
                                                AbstractState state) {
  if (!request.callee) {
    const Span place = contextAt(node, state).place();
    reading_.alarm(Truth::Maybe, {AlarmKind::ProgramNotFound, place});
    if (!request.possible.empty())
      reading_.alarm(Truth::Maybe,
                     {request.freshLocals ? AlarmKind::MacroNesting : AlarmKind::SubprogramNesting, place});
    for (const Callee &callee : request.possible)
      engine_.unfollowed_.emplace(std::pair{callee.file.index(), callee.entry.index()}, callee);
    if (!request.possible.empty())
      return enterUnfollowed(node, request, std::move(state));
    unknownCall(node, request, state, "a program that is not among these files");
    return state;
  }
  nestingAlarms(node, request, state);
  const bool tooDeep = engine_.open_.size() > facts_.file->dialect->limits.totalCallDepth;
  if (!tooDeep && !engine_.isOpen(*request.callee))
    return repeated(node, request, std::move(state));
  engine_.unfollowed_.emplace(std::pair{request.callee->file.index(), request.callee->entry.index()},
                              *request.callee);
  return enterUnfollowed(node, request, std::move(state));
}

/// The program is gone through with nothing known; behind the call anything may have happened, and it may come back to
/// any number that some M99 P names.
std::optional<AbstractState> Propagation::enterUnfollowed(NodeId node, const CallRequest<AbstractReading> &request,
                                                          AbstractState state) {
  state.transformed = Truth::Maybe; // its programs may turn or mirror
  unknownCall(node, request, state,
              request.callee ? "a program that calls itself" : "a program whose number is computed");
  const ReturnTargets &returns = engine_.programs_.returns();
  if (returns.any)
    returnTo(node, AbstractValue::anyNumber(), state);
  else
    for (const std::uint32_t number : returns.numbers)
      returnTo(node, reading_.number(static_cast<double>(number)), state);
  return state;
}

/// Whether the call is one too many.  The same program is gone through once for each depth, and what is known of it
/// holds at any depth: so the alarm is never certain.
void Propagation::nestingAlarms(NodeId node, const CallRequest<AbstractReading> &request, AbstractState &state) {
  const Limits &limits = facts_.file->dialect->limits;
  const CallDepth &depth = engine_.depth_;
  const bool unknown = !engine_.depthKnown_ || engine_.isOpen(*request.callee);
  const Span place = contextAt(node, state).place();
  if (request.freshLocals && (unknown || depth.macros >= limits.macroCallDepth))
    reading_.alarm(Truth::Maybe, {AlarmKind::MacroNesting, place});
  if (unknown || depth.calls >= limits.totalCallDepth ||
      (!request.freshLocals && depth.calls - depth.macros >= limits.subprogramDepth))
    reading_.alarm(Truth::Maybe, {AlarmKind::SubprogramNesting, place});
}

std::optional<AbstractState> Propagation::repeated(NodeId node, const CallRequest<AbstractReading> &request,
                                                   AbstractState state) {
  const std::optional<double> times = reading_.constantOf(request.repeats);
  if (times && *times < 0.5)
    return state;
  auto after = once(node, request, state);
  if (!after && !times)
    return state; // none at all may be asked for
  if (!after || times == 1.0)
    return after;
  // Whether the second pass starts with the arguments or with what the first has left differs by control: with either.
  const auto next = [&](const AbstractState &from) {
    CallRequest<AbstractReading> again = request;
    for (AbstractValue &local : again.locals)
      local = AbstractValue::any();
    AbstractState begins = from;
    if (modal_ && *modal_ < begins.modalCalls.size())
      begins.modalCalls[*modal_].locals = again.locals;
    return once(node, again, std::move(begins));
  };
  if (times && *times <= kMostUnrolled) {
    for (double pass = 2; pass < *times + 0.5 && after; ++pass)
      after = next(*after);
    return after;
  }
  AbstractState all = std::move(*after);
  for (int pass = 0; !engine_.gaveUp_; ++pass) {
    const auto more = next(all);
    if (!more || leq(reading_, *more, all))
      break;
    if (pass < 2)
      joinInto(reading_, all, *more);
    else
      widenInto(reading_, all, *more, facts_.thresholds);
  }
  if (!times)
    joinInto(reading_, all, state);
  return all;
}

std::optional<AbstractState> Propagation::once(NodeId node, const CallRequest<AbstractReading> &request,
                                               AbstractState state) {
  const auto callerLocals = state.locals;
  const auto callerNames = ownNames(engine_.programs_, state);
  const auto callerLoops = state.enteredLoops;
  const auto callerCounters = state.counters;
  if (request.freshLocals)
    state.locals = request.locals;
  for (const auto &name : callerNames)
    state.variables.set(name.first, AbstractValue::vacant());
  state.enteredLoops.clear();
  state.counters.clear();
  StepObserver *observer = reading_.observer();
  reading_.observe(nullptr);
  Summary &summary = engine_.summaryOf(*request.callee, state, modal_ ? modal_ : summary_.modalLimit);
  reading_.observe(observer);
  if (pass_ == Pass::Walk)
    walkInto(node, request, summary);
  reading_.useDialect(*facts_.file->dialect);
  reading_.start();
  std::optional<AbstractState> behind;
  for (const Exit &exit : summary.exits) {
    AbstractState left = translated(reading_, exit.state, summary.entry, state);
    if (modal_ && *modal_ < left.modalCalls.size()) // what the macro leaves in its variables is there at the next call
      left.modalCalls[*modal_].locals = left.locals;
    if (request.freshLocals)
      left.locals = callerLocals;
    putOwnNames(engine_.programs_, left, callerNames);
    left.enteredLoops = callerLoops;
    left.counters = callerCounters;
    if (exit.target)
      returnTo(node, *exit.target, left);
    else
      addTo(behind, std::move(left));
  }
  return behind;
}

void Propagation::walkInto(NodeId node, const CallRequest<AbstractReading> &request, Summary &summary) {
  const CallDepth before = engine_.depth_;
  CallDepth inside{before.calls + 1, before.macros + (request.freshLocals ? 1U : 0U)};
  if (!engine_.depthKnown_)
    inside = {facts_.file->dialect->limits.totalCallDepth, 0};
  if (!summary.walkedAt.insert(inside).second)
    return;
  engine_.depth_ = inside;
  engine_.calls_.push_back(placeOf(node));
  engine_.open_.push_back(*request.callee);
  reading_.useDialect(*engine_.programs_.file(request.callee->file).dialect);
  Propagation(engine_, engine_.factsOf(*request.callee), summary, Pass::Walk).run();
  engine_.open_.pop_back();
  engine_.calls_.pop_back();
  engine_.depth_ = before;
  engine_.visitor_->resumed(placeOf(node), engine_.calls_);
}

void Propagation::addTo(std::optional<AbstractState> &all, AbstractState state) {
  if (all)
    joinInto(reading_, *all, state);
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
    if (pass_ == Pass::Ascend && !isHead(positionOf(*place))) {
      summary_.forcedHeads.insert(positionOf(*place));
      startAgain_ = true;
    }
    deliver(*place, state);
  }
  searchAlarms(node, target);
  reading_.start();
}

bool Propagation::modalCalls(NodeId node, AbstractState &state) {
  const std::size_t usable = std::min(summary_.modalLimit.value_or(~std::size_t{0}), state.modalCalls.size());
  if (usable == 0 && state.modalCallsUnknown == Truth::False)
    return true;
  AbstractContext context = contextAt(node, state);
  const Truth moves = movesAxis(context, words_);
  if (moves == Truth::False)
    return true;
  AbstractState before = state;
  if (mayBeTrue(state.modalCallsUnknown)) {
    CallRequest<AbstractReading> unknown;
    unknown.freshLocals = true;
    unknown.possible = engine_.programs_.modalCallees();
    state = *enter(node, unknown, std::move(state)); // what is not known comes back
  } else {
    const std::size_t last = usable - 1;
    const CallRequest<AbstractReading> request = prepareModalCall(context, state.modalCalls[last]);
    const auto outer = std::exchange(modal_, last);
    auto after = enter(node, request, state);
    modal_ = outer;
    if (!after) { // the block behind is reached only if nothing has moved
      state = std::move(before);
      return moves == Truth::Maybe;
    }
    state = std::move(*after);
  }
  if (moves == Truth::Maybe)
    joinInto(reading_, state, before);
  return true;
}

} // namespace feedhold
