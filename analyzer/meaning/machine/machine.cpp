#include "meaning/machine/machine.h"

#include "meaning/machine/repeat_watch.h"
#include "meaning/machine/run_cutter.h"
#include "meaning/semantics/tool_point.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace feedhold {

bool isReadByName(const ProgramSet &programs, const Dialect &dialect, std::uint32_t variable) {
  const PredefinedName *name = findPredefinedName(dialect, variable);
  return programs.isInputName(variable) || variable == programs.returnedValue() ||
         (name && name->source == NameSource::NotFollowed);
}

namespace {

using State = MachineState<ConcreteInterpretation>;

class Machine {
public:
  Machine(const ProgramSet &programs, Callee entry, const RunOptions &options)
      : programs_(programs), options_(options),
        interpretation_(*programs.file(entry.file).dialect, options.variables, options.words, options.numbers),
        modes_(*programs.file(entry.file).dialect),
        state_(options.state ? *options.state : startState(interpretation_, modes_, options.start)), at_{entry.file,
                                                                                                         entry.entry},
        cutter_(*programs.file(entry.file).dialect) {
    for (const auto &[group, code] : options.codes)
      state_.codes[group] = code;
    putInForce(options.variables.start, state_);
    frames_.push_back({.callee = entry, .call = at_});
    for (const auto &[variable, script] : options.variables.readings.entries()) // what is read is there
      if (programs.isInputName(variable) && !options.variables.find(variable))
        state_.variables.set(variable, ConcreteValue::of(script.front()));
    for (const std::string_view name : {kReturnedValue, kIsValueReturned}) // before any call has returned one
      if (const auto variable = programs.usesName(name) ? programs.variableNamed(name) : std::nullopt;
          variable && !state_.variables.find(*variable))
        state_.variables.set(*variable, ConcreteValue::of(0));
    entry_ = state_;
    interpretation_.takeCodesToReturn(options_.missing == MissingPrograms::Return);
    if (options_.inputs)
      interpretation_.readInputsFrom([this](std::uint32_t variable) { return options_.inputs(at_, variable); });
  }

  RunResult run() {
    while (!ended_) {
      if (result_.steps == options_.fuel || moveCount_ >= options_.mostMoves)
        endWithoutFuel();
      else
        one();
    }
    finishCutter();
    takeCutterAlarm();
    result_.place = at_;
    result_.passedUnmodelled = interpretation_.passedUnmodelled();
    result_.isLost = interpretation_.isLost();
    for (std::size_t i = 1; i < frames_.size(); ++i)
      result_.calls.push_back({frames_[i].call, frames_[i].callee});
    result_.state = std::move(state_);
    result_.skips = interpretation_.skips();
    return std::move(result_);
  }

private:
  StepContext<ConcreteInterpretation> context() {
    return {interpretation_, state_, programs_, programs_.file(at_.file), modes_, node().block};
  }
  const Node &node() const { return programs_.node(at_); }
  const ProgramFile &file() const { return programs_.file(at_.file); }
  const Dialect &dialect() const { return *file().dialect; }

  void one() {
    if (options_.trace)
      options_.trace({at_, state_, frames_.size() - 1, result_.moves.size()});
    if (cycle_)
      cycle_->places.insert(frames_.size() == 1 ? at_ : frames_[1].call);
    ++result_.steps;
    const Place here = at_;
    const Node &current = node();
    if (auto ctx = context(); endsCorner(ctx, current.instruction))
      loseCorner(ctx);
    const std::optional<NodeId> next = match(
        current.instruction, [&](const BlockSkip &skip) { return follow(skip, current); },
        [&](const Test &test) { return follow(test, current); },
        [&](const JumpTo &jump) { return follow(jump, current); },
        [&](const CountDown &count) { return follow(count, current); },
        [&](const CallProgram &call) { return follow(call, current); },
        [&](const ReturnFromProgram &from) { return follow(from); },
        [&](const EndProgram &ending) { return follow(ending); }, [&](const auto &) { return straight(current); });
    takeEffects(here);
    if (!ended_ && next)
      goTo(*next);
  }

  void goTo(NodeId next) {
    const bool backwards = next <= at_.node;
    at_.node = next;
    if (backwards)
      watch();
  }
  void watch() {
    using Outside = RepeatWatch::Outside;
    if (cycle_) {
      if (cycle_->at == at_ && cycle_->frames == frames_ && cycle_->state == state_)
        endInCycle();
      return;
    }
    const Outside outside = interpretation_.takeVolatileReads() ? Outside::Read : Outside::Unread;
    if (watch_.comesBack(at_, state_, frames_, outside))
      cycle_ = std::make_unique<Cycle>(Cycle{at_, state_, frames_, result_.steps, result_.moves.size(), {}});
  }
  void end(RunEnd how) {
    result_.end = how;
    ended_ = true;
  }
  /// The run is told up to where its state came back first.
  void endInCycle() {
    finishCutter();
    result_.cycle.assign(cycle_->places.begin(), cycle_->places.end());
    result_.steps = cycle_->steps;
    result_.moves.erase(result_.moves.begin() + static_cast<std::ptrdiff_t>(cycle_->moves), result_.moves.end());
    end(RunEnd::Repeats);
  }
  void endWithoutFuel() {
    if (!cycle_)
      return end(RunEnd::Fuel);
    cycle_->places.clear();
    at_ = cycle_->at;
    state_ = std::move(cycle_->state);
    frames_ = std::move(cycle_->frames);
    endInCycle();
  }

  // ---- what an instruction has brought ----

  void takeEffects(Place here) {
    const bool refused = interpretation_.stopped().kind == ConcreteInterpretation::Stop::ControlAlarm;
    std::vector<Move<ConcreteValue>> moves = interpretation_.takeMoves();
    const std::size_t first = result_.moves.size();
    const bool begins = !refused && !moves.empty(); // the control does not begin a block that it does not understand
    moveCount_ += begins ? moves.size() : 0;
    if (begins && options_.moves == RecordMoves::Yes)
      record(std::move(moves), here);
    if (!refused && options_.cutter == CutterCompensation::Followed && options_.moves == RecordMoves::Yes)
      compensate(here, first);
    for (std::string &code : interpretation_.takeSkipped())
      result_.skipped.insert(std::move(code));
    for (const std::string_view reason : interpretation_.takeNotes())
      if (noted_.insert({here, reason}).second)
        result_.notes.push_back({reason, here});
    if (interpretation_.stopped().kind != ConcreteInterpretation::Stop::None)
      stop();
    else if (cutter_.alarm())
      end(RunEnd::Alarm);
  }
  /// The block has been executed, and its moves are recorded from `first` on.
  void compensate(Place here, std::size_t first) {
    const Instruction &instruction = programs_.node(here).instruction;
    if (isCallOrReturn(instruction))
      cutter_.passCall();
    if (!std::holds_alternative<ExecuteWords>(instruction) || (words_.codes.empty() && words_.entries.empty()))
      return;
    auto ctx = context();
    if (cutter_.isOff() && !mayCompensate(ctx) && !findPocket(words_))
      return;
    RunCutter host(result_.moves, [&](double number) { return otherOffset(ctx, number); });
    const CutterBlock<double> block = cutterBlockOf(host, ctx, words_);
    result_.offsetIsAssumed = result_.offsetIsAssumed || block.offsetIsAssumed;
    cutter_.take(host, block, {here, frames_.size() - 1}, first, result_.moves.size());
    for (const auto &[reason, place] : cutter_.takeNotes())
      if (noted_.insert({place, reason}).second)
        result_.notes.push_back({reason, place});
  }
  void finishCutter() {
    RunCutter host(result_.moves);
    cutter_.finish(host);
  }
  /// It is told in the units of the start.
  std::optional<CutterOffset<double>> otherOffset(StepContext<ConcreteInterpretation> &ctx, double number) {
    if (!toolPointOf(ctx, entry_).sameUnits || !options_.cutterRadius)
      return std::nullopt;
    const auto known = otherOffsets_.find(number);
    if (known != otherOffsets_.end())
      return known->second;
    return otherOffsets_[number] = options_.cutterRadius(options_, number);
  }
  /// The control stops before a block that it has read ahead: what has been read since is not done.
  void takeCutterAlarm() {
    const auto &alarm = cutter_.alarm();
    if (!alarm)
      return;
    end(RunEnd::Alarm);
    result_.alarm = alarm->kind;
    result_.compensation = alarm->began;
    if (alarm->move < result_.moves.size())
      result_.moves.erase(result_.moves.begin() + static_cast<std::ptrdiff_t>(alarm->move), result_.moves.end());
    if (alarm->depth < frames_.size())
      frames_.resize(alarm->depth + 1, frames_.front());
    at_ = alarm->place;
    result_.alarmSpan = blockSpan();
  }
  void record(std::vector<Move<ConcreteValue>> moves, Place here) {
    auto ctx = context();
    const ToolPoint<ConcreteInterpretation> point = toolPointOf(ctx, entry_, options_.fixed);
    const bool isInAdditional = isInAdditionalSystem(ctx);
    const bool isPlaced =
        !wasLost_ && !interpretation_.isLost() && !std::exchange(wasInAdditional_, isInAdditional) && !isInAdditional;
    const bool isFollowed = isPlaced && (point.withoutCompensation || options_.cutter == CutterCompensation::Followed);
    const bool isBlockOfTool = isFollowed && point.sameUnits && point.sameSide;
    const LengthInForce length = !point.withLength        ? LengthInForce::None
                                 : point.lengthSubtracted ? LengthInForce::Subtracted
                                                          : LengthInForce::Added;
    const Place own = frames_.size() > 1 ? frames_[1].call : here;
    const auto numbers = [](const std::array<ConcreteValue, 3> &values) {
      return std::array{values[0].number, values[1].number, values[2].number};
    };
    for (Move<ConcreteValue> &move : moves) {
      const bool isOfTool = isBlockOfTool && !movesOtherAxis(move);
      result_.moves.push_back({move, unitInForce(), here, own, numbers(point.zero), numbers(point.machineZero),
                               isOfTool && point.lengthKnown, isOfTool, length,
                               isFollowed && point.sameUnits && detail::workOffsetInForce(ctx)});
    }
  }
  bool movesOtherAxis(const Move<ConcreteValue> &move) const {
    const auto isSame = [](const ConcreteValue &a, const ConcreteValue &b) { return a.number == b.number; };
    return std::ranges::any_of(kAllAxes, [&](Axis axis) {
      return isBesideRegions(dialect(), axis) && !options_.fixed[indexOf(axis)] && mayMove(move, axis, isSame);
    });
  }
  /// `G54.1` of which P is not known, or the way from or to one: where its zero point lies is the operator's.  One that
  /// is in force from the start is that of the coordinates of the start.
  bool isInAdditionalSystem(StepContext<ConcreteInterpretation> &ctx) {
    StepContext<ConcreteInterpretation> atStart{interpretation_, entry_, programs_, ctx.file, modes_, ctx.block};
    const bool isKnown = detail::workOffsetInForce(ctx).has_value();
    return isKnown != detail::workOffsetInForce(atStart).has_value() ||
           (!isKnown && !detail::hasSystemOfEntry(ctx, entry_));
  }
  LengthUnit unitInForce() {
    const auto ctx = context();
    return ctx.inForce(ModalKind::Units, {CodeAction::Inch}, false) ? LengthUnit::Inch : LengthUnit::Millimetre;
  }
  void stop() {
    const ConcreteInterpretation::Stopped &stopped = interpretation_.stopped();
    result_.alarm = stopped.alarm;
    result_.alarmNumber = stopped.number;
    result_.alarmSpan = stopped.place.size() == 0 ? blockSpan() : stopped.place;
    if (stopped.kind == ConcreteInterpretation::Stop::UserAlarm)
      result_.alarmText = messageOfBlock();
    end(stopped.kind == ConcreteInterpretation::Stop::UserAlarm ? RunEnd::UserAlarm : RunEnd::Alarm);
  }
  Span blockSpan() const { return file().tree->blocks[node().block].span(); }
  std::string messageOfBlock() const {
    for (const Comment &comment : file().tree->commentsOf(node().block))
      if (comment.closed && comment.span.size() > 2)
        return file().source->utf8({comment.span.begin + 1, comment.span.end - 1});
    return {};
  }

  // ---- instructions: the node that comes next; absent when at_ has been set, or the run has ended ----

  std::optional<NodeId> straight(const Node &here) {
    auto ctx = context();
    wasLost_ = interpretation_.isLost();
    step(ctx, here.instruction, words_);
    if (interpretation_.stopped().kind == ConcreteInterpretation::Stop::None &&
        std::holds_alternative<ExecuteWords>(here.instruction) && movesAxis(ctx, words_) && enterModal())
      return std::nullopt;
    return here.next;
  }
  std::optional<NodeId> follow(const BlockSkip &skip, const Node &here) const {
    return options_.blockSkip == BlockSkipSwitch::On ? skip.skipped : here.next;
  }
  std::optional<NodeId> follow(const Test &test, const Node &here) {
    auto ctx = context();
    return conditionOf(ctx, test) ? test.taken : here.next;
  }
  std::optional<NodeId> follow(const CountDown &count, const Node &here) {
    auto ctx = context();
    return countDown(ctx, count) ? count.taken : here.next;
  }
  std::optional<NodeId> follow(const JumpTo &jump, const Node &here) {
    auto ctx = context();
    return search(jumpTarget(ctx, jump).number, here.block);
  }
  std::optional<NodeId> follow(const EndProgram &ending) {
    if (ending.end != ProgramEnd::EndOfFile) {
      auto ctx = context();
      restoreModesAtEnd(ctx);
    }
    switch (ending.end) {
    case ProgramEnd::M02: end(RunEnd::M02); break;
    case ProgramEnd::M30: end(RunEnd::M30); break;
    case ProgramEnd::EndOfFile: endOfText(); break;
    }
    return std::nullopt;
  }
  void endOfText() {
    if (alarmNumber(dialect(), AlarmKind::EndOfRecord))
      interpretation_.alarm(true, {AlarmKind::EndOfRecord, blockSpan()});
    else
      end(RunEnd::EndOfFile);
  }

  /// The place of N `number` in the program that runs; an alarm when there is none.
  std::optional<NodeId> search(double number, BlockId from) {
    const double lowest = dialect().grammar.sequenceZero ? 0 : 1;
    const Span place = file().tree->blocks[from].span();
    if (!(number >= lowest && number <= dialect().limits.lastSequenceNumber)) {
      interpretation_.alarm(true, {AlarmKind::SequenceOutOfRange, place});
      return std::nullopt;
    }
    const auto found =
        findLabel(file().cfg, *file().model, frames_.back().callee.program, static_cast<std::uint32_t>(number), from);
    interpretation_.alarm(!found, {AlarmKind::SequenceNotFound, place});
    return found;
  }

  // ---- calls ----

  std::optional<NodeId> follow(const CallProgram &call, const Node &here) {
    auto ctx = context();
    const CallRequest<ConcreteInterpretation> request = prepareCall(ctx, call.call);
    if (interpretation_.stopped())
      return here.next;
    switch (request.action) {
    case CallAction::SetModal:
    case CallAction::EndModal: return here.next;
    case CallAction::Operation: return giveUp("an operation of Macro A");
    case CallAction::Enter: break;
    }
    if (!request.callee && file().model->calls[call.call].kind == CallKind::External)
      return giveUp("a program on an external device");
    if (!request.callee && options_.missing != MissingPrograms::Return &&
        programs_.startsInside(at_.file, file().model->calls[call.call]))
      return giveUp("a call that starts at a sequence number");
    return enter(request, std::nullopt) ? std::nullopt : std::optional(here.next);
  }
  std::optional<NodeId> giveUp(std::string_view reason) {
    interpretation_.unmodelled(reason, blockSpan());
    end(RunEnd::Unmodelled);
    return std::nullopt;
  }

  /// After a movement: whether the run goes on in a modal call.
  bool enterModal() {
    const auto modal = modalCallOf(state_, frames_.back().modalLimit);
    if (!modal)
      return false;
    auto ctx = context();
    loseCorner(ctx);
    const CallRequest<ConcreteInterpretation> request = prepareModalCall(ctx, state_.modalCalls[*modal]);
    return !interpretation_.stopped() && enter(request, modal);
  }

  /// Of the program that the block calls, or that the modal call does.
  std::string nameOfCallee(std::optional<std::size_t> modal) const {
    const auto *called = std::get_if<CallProgram>(&node().instruction);
    const FileId from = modal ? FileId(state_.modalCalls[*modal].file) : at_.file;
    const CallId call = modal ? CallId(state_.modalCalls[*modal].call) : called->call;
    return toString(programs_.file(from).model->calls[call].callee);
  }

  /// Whether the run goes on in the program: not after an alarm, nor with L0.
  bool enter(const CallRequest<ConcreteInterpretation> &request, std::optional<std::size_t> modal) {
    if (!request.callee && !request.possible.empty()) {
      giveUp("a program number that several programs have");
      return true;
    }
    if (!request.callee && !request.isLocal && !callsNothing(request.repeats.number) &&
        options_.missing == MissingPrograms::Return) {
      const std::string name = nameOfCallee(modal);
      result_.skipped.insert(name.empty() ? std::string(kComputedCallee) : name);
      auto ctx = context();
      keepReturnedByOther(ctx);
      return false;
    }
    if (!request.callee || callsNothing(request.repeats.number)) {
      interpretation_.alarm(!request.callee, {missingAlarm(request), blockSpan()});
      return false;
    }
    if (const auto alarm = nestingAlarm(dialect().limits, depthOf(frames_), request.freshLocals)) {
      interpretation_.alarm(true, {*alarm, blockSpan()});
      return false;
    }
    const CallSite site{at_, modal, frames_.back().modalLimit};
    frames_.push_back(
        enterCall(programs_, state_, request, site, request.repeats.number, interpretation_, NobodyAsks{}));
    at_ = {request.callee->file, request.callee->entry};
    return true;
  }

  std::optional<NodeId> follow(const ReturnFromProgram &from) {
    auto ctx = context();
    const auto target = returnTarget(ctx, from);
    if (interpretation_.stopped())
      return std::nullopt;
    ConcreteFrame &frame = frames_.back();
    if (frames_.size() == 1) {
      if (target)
        return search(target->number, node().block);
      end(RunEnd::Returned);
    } else if (!target && isCalledAgain(frame)) {
      repeatCall(programs_, state_, frame, interpretation_, NobodyAsks{});
      at_ = {frame.callee.file, frame.callee.entry};
    } else {
      leave(target);
    }
    return std::nullopt;
  }
  void leave(const std::optional<ConcreteValue> &target) {
    const ConcreteFrame frame = std::move(frames_.back());
    frames_.pop_back();
    leaveCall(programs_, state_, frame);
    const Node &caller = programs_.node(frame.call);
    at_ = frame.call;
    const std::optional<NodeId> label = target ? search(target->number, caller.block) : std::nullopt;
    if (target && !label)
      return; // the alarm is at the call
    at_.node = label.value_or(caller.next);
    if (label && *label <= frame.call.node)
      watch();
  }

  const ProgramSet &programs_;
  const RunOptions &options_;
  ConcreteInterpretation interpretation_;
  ModalTable modes_;
  State state_;
  State entry_; // as it was at the start
  Place at_;
  std::vector<ConcreteFrame> frames_;
  ExecutedWords<ConcreteInterpretation> words_;
  RepeatWatch watch_;
  /// A state that came back, and what the run meets on its way round to it.
  struct Cycle {
    Place at;
    State state;
    std::vector<ConcreteFrame> frames;
    std::uint64_t steps;
    std::size_t moves;
    std::set<Place> places;
  };
  std::unique_ptr<Cycle> cycle_; // null until a state has come back
  std::set<std::pair<Place, std::string_view>> noted_;
  RunResult result_;
  CutterPath<RunCutter> cutter_;
  std::map<double, std::optional<CutterOffset<double>>> otherOffsets_; // by D
  bool ended_ = false;
  std::size_t moveCount_ = 0;
  bool wasInAdditional_ = false; // in the last block with moves (isInAdditionalSystem)
  bool wasLost_ = false;         // before the block: where the axes are was not known
};

} // namespace

std::string_view nameOf(RunEnd end) {
  switch (end) {
  case RunEnd::M02: return "M02";
  case RunEnd::M30: return "M30";
  case RunEnd::Returned: return "M99";
  case RunEnd::EndOfFile: return "end-of-file";
  case RunEnd::Alarm:
  case RunEnd::UserAlarm: return "alarm";
  case RunEnd::Fuel: return "fuel";
  case RunEnd::Repeats: return "endless";
  case RunEnd::Unmodelled: return "unmodelled";
  }
  FEEDHOLD_UNREACHABLE("the switch names every end");
}

RunResult run(const ProgramSet &programs, Callee entry, const RunOptions &options) {
  return Machine(programs, entry, options).run();
}

} // namespace feedhold
