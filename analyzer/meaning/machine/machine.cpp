#include "meaning/machine/machine.h"

#include <algorithm>
#include <memory>
#include <set>

namespace feedhold {

namespace {

using State = MachineState<ConcreteReading>;
using Locals = std::array<ConcreteValue, kLocalVariables + 1>;

/// A program that has been entered and not been left.
struct Frame {
  Callee callee;
  Place call;             // the node that called
  double repeatsLeft = 1; // of L, this pass included
  bool ownLocals = false;
  Locals callerLocals;             // of ownLocals
  std::optional<std::size_t> modal; // index of the modal call that this is
  std::size_t modalLimit = 0;      // modal calls below this one apply inside
};

/// Whether the state at a place comes back: the run is a cycle then.  Brent's method: one state is kept, and replaced
/// after 1, 2, 4, .. visits.
class RepeatWatch {
public:
  bool comesBack(Place place, const State &state, std::size_t depth, bool sawVolatile) {
    if (sawVolatile)
      kept_.reset(); // what was read may differ the next time
    if (kept_ && place == place_ && depth == depth_ && equal(*kept_, state))
      return true;
    if (++visits_ < next_)
      return false;
    next_ *= 2;
    kept_ = std::make_unique<State>(state);
    place_ = place;
    depth_ = depth;
    return false;
  }

private:
  static bool equal(const State &a, const State &b) {
    return a.locals == b.locals && a.variables.entries() == b.variables.entries() && a.codes == b.codes &&
           a.position == b.position && a.words == b.words && a.shift == b.shift && a.local == b.local &&
           a.counters == b.counters && a.spindle == b.spindle && a.enteredLoops == b.enteredLoops &&
           a.modalCalls.size() == b.modalCalls.size() && a.modalCalls.empty() && a.cycle.bottom == b.cycle.bottom &&
           a.cycle.retract == b.cycle.retract && a.cycle.initial == b.cycle.initial &&
           a.transform.angle == b.transform.angle && a.transform.scale == b.transform.scale &&
           a.transform.mirrorAt == b.transform.mirrorAt;
  }
  std::unique_ptr<State> kept_;
  Place place_{FileId(0), NodeId(0)};
  std::size_t depth_ = 0;
  std::uint64_t visits_ = 0;
  std::uint64_t next_ = 64;
};

class Machine {
public:
  Machine(const ProgramSet &programs, Callee entry, const RunOptions &options)
      : programs_(programs), options_(options), reading_(*programs.file(entry.file).dialect, options.variables),
        modes_(*programs.file(entry.file).dialect), state_(startState(reading_, modes_, options.start)),
        at_{entry.file, entry.entry} {
    frames_.push_back({entry, at_, 1, false, {}, std::nullopt, 0});
  }

  RunResult run() {
    while (!ended_) {
      if (result_.steps++ >= options_.fuel)
        end(RunEnd::Fuel);
      else
        one();
    }
    result_.place = at_;
    for (std::size_t i = 1; i < frames_.size(); ++i)
      result_.calls.push_back({frames_[i].call});
    result_.state = std::move(state_);
    return std::move(result_);
  }

private:
  StepContext<ConcreteReading> context() {
    return {reading_, state_, programs_, programs_.file(at_.file), modes_, node().block};
  }
  const Node &node() const { return programs_.node(at_); }
  const Dialect &dialect() const { return *programs_.file(at_.file).dialect; }

  void one() {
    if (options_.trace)
      options_.trace(at_, state_, frames_.size() - 1);
    const Node here = node();
    const NodeId next = match(
        here.instruction, [&](const BlockSkip &skip) { return options_.blockSkip ? skip.skipped : here.next; },
        [&](const Test &test) { return test_(test, here); },
        [&](const JumpTo &jump) { return jump_(jump, here); },
        [&](const CountDown &count) {
          auto ctx = context();
          return countDown(ctx, count) ? count.taken : here.next;
        },
        [&](const CallProgram &call) { return call_(call, here); },
        [&](const ReturnFromProgram &from) { return return_(from); },
        [&](const EndProgram &ending) { return end_(ending); },
        [&](const auto &) { return straight(here); });
    takeEffects(here);
    if (ended_)
      return;
    goTo(next);
  }

  /// After `next` has been decided; a call or return has set at_ itself and says so by moved_.
  void goTo(NodeId next) {
    if (std::exchange(moved_, false))
      return;
    const bool backwards = next <= at_.node;
    at_.node = next;
    if (backwards && watch_.comesBack(at_, state_, frames_.size(), reading_.takeVolatileReads()))
      end(RunEnd::Repeats);
  }

  void end(RunEnd how) {
    result_.end = how;
    ended_ = true;
  }

  void takeEffects(const Node &here) {
    for (Move<ConcreteValue> &move : reading_.takeMoves())
      result_.moves.push_back({std::move(move), at_});
    for (const std::string_view reason : reading_.takeNotes())
      if (noted_.insert({at_, reason}).second)
        result_.notes.push_back({reason, at_});
    const ConcreteReading::Stopped &stopped = reading_.stopped();
    if (stopped.kind == ConcreteReading::Stop::None)
      return;
    result_.alarm = stopped.alarm;
    result_.alarmNumber = stopped.number;
    result_.alarmSpan = stopped.place;
    if (stopped.kind == ConcreteReading::Stop::UserAlarm) {
      const ProgramFile &file = programs_.file(at_.file);
      for (const Comment &comment : file.tree->commentsOf(here.block))
        if (result_.alarmText.empty() && comment.span.size() > 2)
          result_.alarmText = file.source->text({comment.span.begin + 1, comment.span.end - 1});
    }
    end(stopped.kind == ConcreteReading::Stop::UserAlarm ? RunEnd::UserAlarm : RunEnd::Alarm);
  }

  // ---- instructions ----

  NodeId straight(const Node &here) {
    auto ctx = context();
    step(ctx, here.instruction, words_);
    if (std::holds_alternative<ExecuteWords>(here.instruction) && !state_.modalCalls.empty() &&
        movesAxis(ctx, words_) && reading_.stopped().kind == ConcreteReading::Stop::None)
      enterModal(here);
    return here.next;
  }
  NodeId test_(const Test &test, const Node &here) {
    auto ctx = context();
    return conditionOf(ctx, test) ? test.taken : here.next;
  }
  NodeId jump_(const JumpTo &jump, const Node &here) {
    auto ctx = context();
    return search(frames_.back().callee.program, jumpTarget(ctx, jump).number, here.block).value_or(here.next);
  }
  /// The place of N `number` in the program; stops the run when there is none.
  std::optional<NodeId> search(ProgramId program, double number, BlockId from) {
    const ProgramFile &file = programs_.file(at_.file);
    const double lowest = dialect().grammar.sequenceZero ? 0 : 1;
    if (!(number >= lowest && number <= dialect().limits.lastSequenceNumber)) {
      reading_.alarm(true, {AlarmKind::SequenceOutOfRange, file.tree->blocks[from].span()});
      return std::nullopt;
    }
    const auto found = findLabel(file.cfg, *file.model, program, static_cast<std::uint32_t>(number), from);
    if (!found)
      reading_.alarm(true, {AlarmKind::SequenceNotFound, file.tree->blocks[from].span()});
    return found;
  }

  NodeId call_(const CallProgram &call, const Node &here) {
    auto ctx = context();
    const CallRequest<ConcreteReading> request = prepareCall(ctx, call.call);
    switch (request.action) {
    case CallAction::SetModal:
    case CallAction::EndModal:
      break;
    case CallAction::Operation:
      reading_.notModelled("an operation of Macro A", ctx.place());
      end(RunEnd::NotModelled);
      break;
    case CallAction::Enter:
      enter(request, std::nullopt);
      break;
    }
    return here.next;
  }

  void enterModal(const Node &here) {
    const std::size_t limit = std::min(frames_.back().modalLimit, state_.modalCalls.size());
    const std::size_t usable = frames_.back().modal ? limit : state_.modalCalls.size();
    if (usable == 0)
      return;
    (void)here;
    auto ctx = context();
    enter(prepareModalCall(ctx, state_.modalCalls[usable - 1]), usable - 1);
  }

  void enter(const CallRequest<ConcreteReading> &request, std::optional<std::size_t> modal) {
    const Span place = programs_.file(at_.file).tree->blocks[node().block].span();
    if (!request.callee)
      return reading_.alarm(true, {AlarmKind::ProgramNotFound, place});
    if (request.repeats.number < 0.5)
      return;
    if (const auto alarm = nestingAlarm(request.freshLocals))
      return reading_.alarm(true, {*alarm, place});
    Frame frame{*request.callee, at_, request.repeats.number, request.freshLocals, state_.locals, modal, 0};
    frame.modalLimit = modal.value_or(frames_.back().modal ? frames_.back().modalLimit : state_.modalCalls.size());
    frames_.push_back(frame);
    if (request.freshLocals)
      state_.locals = request.locals;
    moveTo({request.callee->file, request.callee->entry});
  }
  std::optional<AlarmKind> nestingAlarm(bool macro) const {
    const Limits &limits = dialect().limits;
    const auto macros = std::count_if(frames_.begin(), frames_.end(), [](const Frame &f) { return f.ownLocals; });
    if (macro && macros >= limits.macroCallDepth)
      return AlarmKind::MacroNesting;
    if (frames_.size() > limits.totalCallDepth)
      return AlarmKind::SubprogramNesting;
    return std::nullopt;
  }
  void moveTo(Place place) {
    if (place.file != at_.file) {
      reading_.useDialect(*programs_.file(place.file).dialect);
    }
    at_ = place;
    moved_ = true;
  }

  NodeId return_(const ReturnFromProgram &from) {
    auto ctx = context();
    const auto target = returnTarget(ctx, from);
    Frame &frame = frames_.back();
    if (frames_.size() == 1) {
      end(RunEnd::Returned);
      return at_.node;
    }
    if (!target && frame.repeatsLeft >= 1.5) {
      frame.repeatsLeft -= 1;
      moveTo({frame.callee.file, frame.callee.entry});
      return at_.node;
    }
    leave(target);
    return at_.node;
  }
  void leave(const std::optional<ConcreteValue> &target) {
    const Frame frame = frames_.back();
    frames_.pop_back();
    if (frame.modal && *frame.modal < state_.modalCalls.size())
      state_.modalCalls[*frame.modal].locals = state_.locals;
    if (frame.ownLocals)
      state_.locals = frame.callerLocals;
    const Node caller = programs_.node(frame.call);
    moveTo({frame.call.file, caller.next});
    if (!target)
      return;
    if (const auto label = search(frames_.back().callee.program, target->number, caller.block))
      at_.node = *label;
  }

  NodeId end_(const EndProgram &ending) {
    switch (ending.end) {
    case ProgramEnd::M02:
      end(RunEnd::M02);
      break;
    case ProgramEnd::M30:
      end(RunEnd::M30);
      break;
    case ProgramEnd::EndOfFile:
      end(RunEnd::EndOfFile);
      break;
    }
    return at_.node;
  }

  const ProgramSet &programs_;
  const RunOptions &options_;
  ConcreteReading reading_;
  ModalTable modes_;
  State state_;
  Place at_;
  std::vector<Frame> frames_;
  ExecutedWords<ConcreteReading> words_;
  RepeatWatch watch_;
  std::set<std::pair<Place, std::string_view>> noted_;
  RunResult result_;
  bool moved_ = false;
  bool ended_ = false;
};

} // namespace

std::string_view nameOf(RunEnd end) {
  switch (end) {
  case RunEnd::M02:
    return "M02";
  case RunEnd::M30:
    return "M30";
  case RunEnd::Returned:
    return "M99";
  case RunEnd::EndOfFile:
    return "end-of-file";
  case RunEnd::Alarm:
  case RunEnd::UserAlarm:
    return "alarm";
  case RunEnd::Fuel:
    return "fuel";
  case RunEnd::Repeats:
    return "endless";
  case RunEnd::NotModelled:
    return "not-modelled";
  }
  return "";
}

RunResult run(const ProgramSet &programs, Callee entry, const RunOptions &options) {
  return Machine(programs, entry, options).run();
}

} // namespace feedhold
