// Frames: what happens to the state when a program is called, repeated and left, for every interpretation.
//
// An interpretation decides which path goes on, and what a summary of a call is; what the called program finds, and
// what its caller finds behind the call, is decided here.  Every entry of a program is told to `entered`: the first
// one, each repetition (L), and each one that a modal call makes.  So whatever is to be checked of a call is checked of
// all.
#pragma once

#include "meaning/semantics/calls.h"

#include <algorithm>

namespace feedhold {

/// Own names of a level: named variables that no other program sees.
template <typename R> using NamedValues = std::vector<typename VariableMap<typename R::Value>::Entry>;

/// The modes that a level has saved (saved_modes.h).
template <typename R> struct SavedModes {
  decltype(MachineState<R>::savedCodes) codes = {};
  decltype(MachineState<R>::savedWords) words = {};
  typename R::Truth restores = {};

  static SavedModes of(const MachineState<R> &state) {
    return {state.savedCodes, state.savedWords, state.restoresModes};
  }
  void putInto(MachineState<R> &state) const {
    state.savedCodes = codes;
    state.savedWords = words;
    state.restoresModes = restores;
  }
  friend bool operator==(const SavedModes &, const SavedModes &) = default;
};

/// A program that has been entered and not left.
template <typename R> struct Frame {
  using Value = typename R::Value;

  Callee callee;
  Place call;             // the node that called; of the first frame, where the run began
  double repeatsLeft = 1; // of L, this one included
  bool ownLocals = false;
  std::array<Value, kLocalVariables + 1> arguments = {}; // of ownLocals, as the next one
  std::array<Value, kLocalVariables + 1> callerLocals = {};
  NamedValues<R> callerNames = {};
  decltype(MachineState<R>::enteredLoops) callerLoops = {};
  decltype(MachineState<R>::counters) callerCounters = {};
  SavedModes<R> callerSaved = {};
  std::optional<std::size_t> modal = {};      // the modal call that this is: its index in MachineState::modalCalls
  std::optional<std::size_t> modalLimit = {}; // only modal calls below this one apply inside; absent: all

  friend bool operator==(const Frame &, const Frame &) = default;
};

/// Whence a program is called.
struct CallSite {
  Place call;
  std::optional<std::size_t> modal = {};      // as in Frame
  std::optional<std::size_t> modalLimit = {}; // of the calling program
};

/// How many calls are open, and how many of them have locals of their own.
struct CallDepth {
  std::size_t calls = 0;
  std::size_t macros = 0;
  CallDepth inside(bool ownLocals) const { return {calls + 1, macros + (ownLocals ? 1U : 0U)}; }
  friend auto operator<=>(const CallDepth &, const CallDepth &) = default;
};
template <typename R> CallDepth depthOf(const std::vector<Frame<R>> &frames);

/// The alarm of a call that is one too many.
inline std::optional<AlarmKind> nestingAlarm(const Limits &limits, CallDepth depth, bool ownLocals);

/// The modal call that a movement of a program makes, of those that are known: the innermost.  A program that is a
/// modal call itself makes only those that were in force before its own.
template <typename R>
std::optional<std::size_t> modalCallOf(const MachineState<R> &state, std::optional<std::size_t> modalLimit);
/// What a call does whose program is in none of the files.
enum class MissingPrograms : std::uint8_t {
  Stop,       // the control stops with an alarm: it does not have the program either
  Return,     // the control has the program, which returns behind its call without an alarm, starts no modal call and
              // ends none; a run takes it to change nothing, a proof lets it change all that a called program can
  DoAnything, // the control may stop, the program may stop it, or never return
};

/// How a missing program is named that a call finds by a computed number.
inline constexpr std::string_view kComputedCallee = "a program with a computed number";

/// The alarm of a call that finds nothing.
template <typename R> AlarmKind missingAlarm(const CallRequest<R> &request) {
  return request.isLocal ? AlarmKind::SequenceNotFound : AlarmKind::ProgramNotFound;
}

/// Some modal call is or may be in force in a program.
template <typename R>
typename R::Truth mayCallModally(R &interpretation, const MachineState<R> &state,
                                 std::optional<std::size_t> modalLimit);

/// L, where it is one number.
template <typename R> std::optional<double> repeatsOf(R &interpretation, const CallRequest<R> &request) {
  return interpretation.constantOf(request.repeats);
}
/// L0: nothing is called.
constexpr bool callsNothing(double repeats) { return repeats < 0.5; }
template <typename R> bool isCalledAgain(const Frame<R> &frame) { return frame.repeatsLeft >= 1.5; }

/// Nobody asks about the entries of programs.
struct NobodyAsks {
  template <typename R> void operator()(const Frame<R> &, const MachineState<R> &) const {}
};

/// Of a request with a callee.  Calls entered(frame, state) at the entry of the program.
template <typename R, typename Entered>
Frame<R> enterCall(const ProgramSet &programs, MachineState<R> &state, const CallRequest<R> &request,
                   const CallSite &site, double repeats, R &interpretation, Entered &&entered);
/// The program has returned and is entered once more.
template <typename R, typename Entered>
void repeatCall(const ProgramSet &programs, MachineState<R> &state, Frame<R> &frame, R &interpretation,
                Entered &&entered);
/// The program has returned for the last time.
template <typename R> void leaveCall(const ProgramSet &programs, MachineState<R> &state, const Frame<R> &frame);

/// A call of what is not followed: anything may happen to what a called program sees.
template <typename R> void havocCall(StepContext<R> &context, const CallRequest<R> &request, std::string_view reason);

// ---- implementation -----------------------------------------------------------------------------------------------

template <typename R> CallDepth depthOf(const std::vector<Frame<R>> &frames) {
  const auto macros = std::count_if(frames.begin(), frames.end(), [](const Frame<R> &each) { return each.ownLocals; });
  return {frames.size() - 1, static_cast<std::size_t>(macros)};
}

inline std::optional<AlarmKind> nestingAlarm(const Limits &limits, CallDepth depth, bool ownLocals) {
  if (ownLocals && depth.macros >= limits.macroCallDepth)
    return AlarmKind::MacroNesting;
  if (depth.calls >= limits.totalCallDepth || (!ownLocals && depth.calls - depth.macros >= limits.subprogramDepth))
    return AlarmKind::SubprogramNesting;
  return std::nullopt;
}

template <typename R>
std::optional<std::size_t> modalCallOf(const MachineState<R> &state, std::optional<std::size_t> modalLimit) {
  const std::size_t usable = std::min(modalLimit.value_or(state.modalCalls.size()), state.modalCalls.size());
  return usable == 0 ? std::nullopt : std::optional(usable - 1);
}

template <typename R>
typename R::Truth mayCallModally(R &interpretation, const MachineState<R> &state,
                                 std::optional<std::size_t> modalLimit) {
  return modalCallOf(state, modalLimit) ? interpretation.truth(true) : state.modalCallsUnknown;
}

namespace detail {

template <typename R> NamedValues<R> ownNames(const ProgramSet &programs, const MachineState<R> &state) {
  NamedValues<R> names;
  for (const auto &entry : state.variables.entries())
    if (programs.isLocalName(entry.first))
      names.push_back(entry);
  return names;
}

/// No loop has been entered, nothing is counted or saved, no name has been given a value.
template <typename R> void beginLevel(const ProgramSet &programs, MachineState<R> &state, R &interpretation) {
  state.enteredLoops.clear();
  state.counters.clear();
  SavedModes<R>{.restores = interpretation.truth(false)}.putInto(state);
  // Those that the state does not list may hold anything, and not what they hold in the calling level.
  for (const std::uint32_t variable : programs.localNames())
    state.variables.set(variable, interpretation.vacant());
}

} // namespace detail

template <typename R, typename Entered>
Frame<R> enterCall(const ProgramSet &programs, MachineState<R> &state, const CallRequest<R> &request,
                   const CallSite &site, double repeats, R &interpretation, Entered &&entered) {
  Frame<R> frame{.callee = *request.callee,
                 .call = site.call,
                 .repeatsLeft = repeats,
                 .ownLocals = request.freshLocals,
                 .callerNames = detail::ownNames(programs, state),
                 .callerLoops = state.enteredLoops,
                 .callerCounters = state.counters,
                 .callerSaved = SavedModes<R>::of(state),
                 .modal = site.modal,
                 .modalLimit = site.modal ? site.modal : site.modalLimit};
  if (request.freshLocals) {
    frame.arguments = request.locals;
    frame.callerLocals = std::exchange(state.locals, request.locals);
  }
  detail::beginLevel(programs, state, interpretation);
  entered(std::as_const(frame), std::as_const(state));
  return frame;
}

template <typename R, typename Entered>
void repeatCall(const ProgramSet &programs, MachineState<R> &state, Frame<R> &frame, R &interpretation,
                Entered &&entered) {
  frame.repeatsLeft -= 1;
  detail::beginLevel(programs, state, interpretation);
  if (frame.ownLocals) {
    // With what the last repetition has left (Haas, Mill Operator's Manual, G65), or with the arguments: others are
    // silent.
    const auto asLeft = interpretation.unknownTruth();
    for (std::size_t local = 1; local <= kLocalVariables; ++local)
      state.locals[local] = interpretation.select(asLeft, state.locals[local], frame.arguments[local]);
  }
  entered(std::as_const(frame), std::as_const(state));
}

template <typename R> void leaveCall(const ProgramSet &programs, MachineState<R> &state, const Frame<R> &frame) {
  if (frame.modal && *frame.modal < state.modalCalls.size()) // they are there at the next call
    state.modalCalls[*frame.modal].locals = state.locals;
  state.enteredLoops = frame.callerLoops;
  state.counters = frame.callerCounters;
  frame.callerSaved.putInto(state);
  if (frame.ownLocals)
    state.locals = frame.callerLocals;
  std::erase_if(state.variables.entries(), [&](const auto &entry) { return programs.isLocalName(entry.first); });
  for (const auto &[variable, value] : frame.callerNames)
    state.variables.set(variable, value);
}

template <typename R> void havocCall(StepContext<R> &context, const CallRequest<R> &request, std::string_view reason) {
  MachineState<R> &state = context.state;
  const auto locals = state.locals;
  const auto names = detail::ownNames(context.programs, state);
  const auto loops = state.enteredLoops;
  const auto counters = state.counters;
  const auto saved = SavedModes<R>::of(state);
  context.interpretation.havoc(state, reason, context.place());
  if (request.freshLocals)
    state.locals = locals;
  state.enteredLoops = loops;
  state.counters = counters;
  saved.putInto(state);
  for (const auto &[variable, value] : names)
    state.variables.set(variable, value);
}

} // namespace feedhold
