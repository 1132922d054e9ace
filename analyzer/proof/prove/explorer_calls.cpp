// Calls: the programs that a block calls, or that a modal call calls after a movement.
#include "proof/prove/explorer.h"
#include "proof/prove/path_memory.h"

#include <algorithm>
#include <set>

namespace feedhold::prove {

using smt::TermId;

namespace {

constexpr double kMostRepeats = 100;

} // namespace

std::vector<Path> Explorer::follow(Path path, const CallProgram &call) {
  auto context = contextOf(path);
  const CallRequest<SymbolicReading> request = prepareCall(context, call.call);
  const NodeId next = nodeOf(path).next;
  if (!takeChecks(path))
    return {};
  switch (request.action) {
  case CallAction::SetModal:
  case CallAction::EndModal: return {to(std::move(path), next)};
  case CallAction::Operation: return unknownCall(std::move(path), request, "an operation of Macro A");
  case CallAction::Enter: break;
  }
  return enter(std::move(path), request, std::nullopt);
}

/// After a movement: the innermost modal call that applies here, if any.
std::vector<Path> Explorer::modalCall(Path path, Condition moves) {
  const NodeId next = nodeOf(path).next;
  const std::size_t usable =
      std::min(path.frames.back().modalLimit.value_or(~std::size_t{0}), path.state.modalCalls.size());
  const bool unknown = path.state.modalCallsUnknown.term != store_.no();
  if (usable == 0 && !unknown)
    return {to(std::move(path), next)};
  std::vector<Path> paths;
  if (isPossible(path, store_.logicalNot(moves.term))) {
    Path still = to(path, next);
    if (still.assume(store_, store_.logicalNot(moves.term)))
      paths.push_back(std::move(still));
  }
  if (!isPossible(path, moves.term) || !path.assume(store_, moves.term))
    return paths;
  auto context = contextOf(path);
  std::vector<Path> called;
  if (unknown) {
    CallRequest<SymbolicReading> request;
    request.freshLocals = true;
    request.repeats = reading_.number(1);
    called = unknownCall(std::move(path), request, "a modal call that is not known");
  } else {
    const auto request = prepareModalCall(context, path.state.modalCalls[usable - 1]);
    called = enter(std::move(path), request, usable - 1);
  }
  std::move(called.begin(), called.end(), std::back_inserter(paths));
  return paths;
}

/// Of what is not known, or not followed: it may do anything to what the called program sees, and comes back.
std::vector<Path> Explorer::unknownCall(Path path, const CallRequest<SymbolicReading> &request,
                                        std::string_view reason) {
  if (mayReach(request, path.frames.front().callee)) // what is claimed of its blocks is claimed there too
    giveUp("a call that is not followed may lead back to the program");
  if (purpose_ == Purpose::Record) {
    UnfollowedCall &call = result_.unfollowedCalls.emplace_back(UnfollowedCall{ownPlace(path), path.conditions, {}});
    for (const OpenLoop &loop : path.loops)
      call.loops.push_back(loop.instance);
  }
  const auto locals = path.state.locals;
  const auto loops = path.state.enteredLoops;
  const auto counters = path.state.counters;
  auto context = contextOf(path);
  reading_.havoc(path.state, reason, context.place());
  if (request.freshLocals)
    path.state.locals = locals;
  path.state.enteredLoops = loops;
  path.state.counters = counters;
  // It may stop with an alarm of its own, and it may come back to any number that some M99 P names.
  const NodeId next = nodeOf(path).next;
  const ReturnTargets &returns = programs_.returns();
  if (returns.any || !returns.numbers.empty())
    giveUp("an unknown program may return to any sequence number");
  if (!takeChecks(path))
    return {};
  return {to(std::move(path), next)};
}

/// A program that is in none of the files is taken to call none of them.
bool Explorer::mayReach(const CallRequest<SymbolicReading> &request, const Callee &program) const {
  std::vector<Callee> open = request.possible;
  if (request.callee)
    open.push_back(*request.callee);
  std::set<std::pair<FileId, ProgramId>> seen;
  while (!open.empty()) {
    const Callee at = open.back();
    open.pop_back();
    if (at.file == program.file && at.program == program.program)
      return true;
    if (!seen.emplace(at.file, at.program).second)
      continue;
    const ProgramModel &model = *programs_.file(at.file).model;
    for (std::size_t i = 0; i < model.calls.size(); ++i) {
      const Call &call = model.calls[CallId(i)];
      if (call.caller != at.program)
        continue;
      if (const auto callee = programs_.callee(at.file, CallId(i)))
        open.push_back(*callee);
      else if (call.programWord && call.callee.empty()) // a number that is computed
        return true;
    }
  }
  return false;
}

std::optional<AlarmKind> Explorer::nestingAlarm(const Path &path, bool macro) const {
  const Limits &limits = programs_.file(path.at.file).dialect->limits;
  const auto open = path.frames.size() - 1;
  const auto macros = static_cast<std::size_t>(std::count_if(
      path.frames.begin(), path.frames.end(), [](const SymbolicFrame &frame) { return frame.ownLocals; }));
  if (macro && macros >= limits.macroCallDepth)
    return AlarmKind::MacroNesting;
  if (open >= limits.totalCallDepth || (!macro && open - macros >= limits.subprogramDepth))
    return AlarmKind::SubprogramNesting;
  return std::nullopt;
}

std::vector<VariableMap<SymbolicValue>::Entry> Explorer::takeOwnNames(SymbolicState &state) const {
  auto &entries = state.variables.entries();
  const auto isShared = [&](const auto &entry) {
    return entry.first < kFirstNamedVariable || isPathMemory(entry.first) || programs_.isGlobalName(entry.first);
  };
  const auto own = std::stable_partition(entries.begin(), entries.end(), isShared);
  std::vector<VariableMap<SymbolicValue>::Entry> names(own, entries.end());
  entries.erase(own, entries.end());
  return names;
}

std::vector<Path> Explorer::enter(Path path, const CallRequest<SymbolicReading> &request,
                                  std::optional<std::size_t> modal) {
  const NodeId next = nodeOf(path).next;
  if (!request.callee) {
    stopsWhen(path, reading_.unknownTruth(), AlarmKind::ProgramNotFound);
    return unknownCall(std::move(path), request, "a program that is not among these files");
  }
  const auto repeats = reading_.constantOf(request.repeats);
  if (repeats && *repeats < 0.5)
    return {to(std::move(path), next)};
  if (!repeats || *repeats > kMostRepeats)
    return unknownCall(std::move(path), request, "a call that is repeated a number of times that is not known");
  if (const auto alarm = nestingAlarm(path, request.freshLocals)) {
    stopsWhen(path, reading_.truth(true), *alarm);
    takeChecks(path);
    return {};
  }
  SymbolicFrame frame{.callee = *request.callee,
                      .call = path.at,
                      .repeatsLeft = *repeats,
                      .ownLocals = request.freshLocals,
                      .modal = modal,
                      .modalLimit = modal ? modal : path.frames.back().modalLimit};
  frame.callerLoops = std::exchange(path.state.enteredLoops, {});
  frame.callerCounters = std::exchange(path.state.counters, {});
  if (request.freshLocals)
    frame.callerLocals = std::exchange(path.state.locals, request.locals);
  frame.callerNames = takeOwnNames(path.state);
  if (purpose_ == Purpose::Record && options_.keepCall && options_.keepCall(*request.callee))
    result_.calls.push_back({path.at, *request.callee, path.conditions, path.state});
  path.frames.push_back(std::move(frame));
  path.at = {request.callee->file, request.callee->entry};
  return {std::move(path)};
}

std::vector<Path> Explorer::follow(Path path, const ReturnFromProgram &from) {
  auto context = contextOf(path);
  const auto target = returnTarget(context, from);
  if (!takeChecks(path))
    return {};
  SymbolicFrame &frame = path.frames.back();
  if (path.frames.size() == 1) {
    if (target) {
      const BlockId block = nodeOf(path).block;
      return search(std::move(path), *target, block);
    }
    exit(path, ExitKind::Returns);
    return {};
  }
  if (!target && frame.repeatsLeft >= 1.5) {
    frame.repeatsLeft -= 1;
    path.state.enteredLoops.clear();
    path.state.counters.clear();
    takeOwnNames(path.state);
    if (frame.ownLocals) // whether the next pass starts with the arguments or with what this one has left differs
      for (std::size_t local = 1; local <= kLocalVariables; ++local)
        path.state.locals[local] = reading_.anything();
    path.at = {frame.callee.file, frame.callee.entry};
    return {std::move(path)};
  }
  return leave(std::move(path), target);
}

std::vector<Path> Explorer::leave(Path path, const std::optional<SymbolicValue> &target) {
  const SymbolicFrame frame = std::move(path.frames.back());
  path.frames.pop_back();
  if (frame.modal && *frame.modal < path.state.modalCalls.size())
    path.state.modalCalls[*frame.modal].locals = path.state.locals;
  path.state.enteredLoops = frame.callerLoops;
  path.state.counters = frame.callerCounters;
  if (frame.ownLocals)
    path.state.locals = frame.callerLocals;
  takeOwnNames(path.state); // those of the program that ends
  for (const auto &[variable, value] : frame.callerNames)
    path.state.variables.set(variable, value);
  path.at = frame.call;
  const Node &caller = nodeOf(path);
  if (target)
    return search(std::move(path), *target, caller.block);
  return {to(std::move(path), caller.next)};
}

} // namespace feedhold::prove
