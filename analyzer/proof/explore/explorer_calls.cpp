// Calls: the programs that a block calls, or that a modal call calls after a movement.
#include "meaning/cfg/reached_programs.h"
#include "proof/explore/explorer.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::prove {

using smt::TermId;

namespace {

constexpr double kMostRepeats = 100;
constexpr std::size_t kMostCallees = 16; // of a computed number

/// By number; absent where a number is that of several programs, or where there are too many.
std::optional<std::map<std::uint32_t, Callee>> byNumber(const ProgramSet &programs,
                                                        const std::vector<Callee> &callees) {
  std::map<std::uint32_t, Callee> found;
  for (const Callee &callee : callees) {
    const auto number = programs.file(callee.file).model->programs[callee.program].name.number;
    if (!number || found.size() == kMostCallees || !found.emplace(*number, callee).second)
      return std::nullopt;
  }
  return found;
}

} // namespace

std::vector<Path> Explorer::follow(Path path, const CallProgram &call) {
  auto context = contextOf(path);
  auto writes = beginWrites(path);
  const CallRequest<SymbolicInterpretation> request = prepareCall(context, call.call);
  const NodeId next = nodeOf(path).next;
  if (!takeStops(path))
    return {};
  if (writes) // a call by T hands it over in a variable
    takeWrites(path, *writes);
  switch (request.action) {
  case CallAction::SetModal:
  case CallAction::EndModal: return {to(std::move(path), next)};
  case CallAction::Operation:
    return unknownCall(std::move(path), request, std::nullopt, "an operation of Macro A",
                       "operations of Macro A are not modelled");
  case CallAction::Enter: break;
  }
  return enter(std::move(path), request, std::nullopt);
}

/// After a movement: the innermost modal call that applies here, if any.
std::vector<Path> Explorer::modalCall(Path path, Condition moves) {
  const NodeId next = nodeOf(path).next;
  const auto modal = modalCallOf(path.state, path.frames.back().modalLimit);
  const bool unknown = path.state.modalCallsUnknown.term != store_.no();
  if (!modal && !unknown)
    return {to(std::move(path), next)};
  auto beforeCall = contextOf(path);
  loseCorner(beforeCall);
  if (!takeStops(path))
    return {};
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
    CallRequest<SymbolicInterpretation> request;
    request.freshLocals = true;
    request.repeats = interpretation_.number(1);
    called = unknownCall(std::move(path), request, std::nullopt, "an unknown modal call",
                         "which modal call is active is unknown");
  } else {
    const auto request = prepareModalCall(context, path.state.modalCalls[*modal]);
    called = enter(std::move(path), request, modal);
  }
  std::move(called.begin(), called.end(), std::back_inserter(paths));
  return paths;
}

/// Of an unknown or unmodelled program: it may do anything to what it can see, and returns behind the call.
std::vector<Path> Explorer::unknownCall(Path path, const CallRequest<SymbolicInterpretation> &request,
                                        std::optional<std::size_t> modal, std::string_view reason, std::string why) {
  if (mayReach(request, path.frames.front().callee)) // what is claimed of its blocks is claimed there too
    giveUp("an unmodelled call may re-enter this program");
  loseCutter(path, "cutter compensation through a call that is not followed");
  recordUnmodelledCall(path, {ownPlace(path), path.conditions, {}, std::move(why)});
  recordUnmodelledEntries(path, request, modal);
  auto context = contextOf(path);
  havocCall(context, request, reason);
  // It may stop with an alarm of its own, and it may come back to any number that some M99 P names.
  const NodeId next = nodeOf(path).next;
  const ReturnTargets &returns = programs_.returns();
  if (returns.any || !returns.numbers.empty())
    giveUp("an unmodelled program may return to any sequence number (M99 P)");
  if (!takeStops(path))
    return {};
  return {to(std::move(path), next)};
}

/// Of a program that is taken to return behind the call.  The modal calls that were active still are; its movements may
/// have made them, so that their variables hold anything.
std::vector<Path> Explorer::missingCall(Path path, const CallRequest<SymbolicInterpretation> &request,
                                        std::optional<std::size_t> modal, const std::string &name) {
  const NodeId next = nodeOf(path).next;
  recordUnmodelledCall(path, {ownPlace(path), path.conditions, {}, fmt::format("{} was not supplied", name), name});
  if (options_.missingChangeNothing) {
    auto context = contextOf(path);
    keepReturnedByOther(context);
    return {to(std::move(path), next)};
  }
  loseCutter(path, "cutter compensation through a call that is not followed");
  recordUnmodelledEntries(path, request, modal);
  auto context = contextOf(path);
  const Condition unknown = path.state.modalCallsUnknown;
  havocCall(context, request, "a program that was not supplied");
  keepReturnedByOther(context);
  path.state.modalCallsUnknown = unknown;
  if (!takeStops(path))
    return {};
  return {to(std::move(path), next)};
}

void Explorer::recordUnmodelledCall(const Path &path, UnmodelledCall call) {
  if (purpose_ != Purpose::Record)
    return;
  for (const OpenLoop &loop : path.loops)
    call.loops.push_back(loop.instance);
  result_.unmodelledCalls.push_back(std::move(call));
}

std::string Explorer::nameOfCallee(const Path &path, std::optional<std::size_t> modal) const {
  if (modal) {
    const auto &call = path.state.modalCalls[*modal];
    return toString(programs_.file(FileId(call.file)).model->calls[CallId(call.call)].callee);
  }
  const auto *call = std::get_if<CallProgram>(&nodeOf(path).instruction);
  return call ? toString(fileOf(path).model->calls[call->call].callee) : std::string();
}

/// A program that was not supplied is assumed to call none of those that were.
bool Explorer::mayReach(const CallRequest<SymbolicInterpretation> &request, const Callee &program) const {
  ReachedPrograms reached;
  for (const Callee &each : request.possible)
    collectReached(programs_, {each.file, each.program}, reached);
  if (request.callee)
    collectReached(programs_, {request.callee->file, request.callee->program}, reached);
  return reached.orAny || reached.programs.contains({program.file, program.program});
}

/// A call in the text of another program is an obligation of that program's own proof.  A modal call that a movement of
/// another program makes is not: that proof assumes that none is active.
void Explorer::recordEntry(const Path &path, std::size_t callerDepth, const SymbolicFrame &frame,
                           const SymbolicState &state) {
  if (purpose_ != Purpose::Record || !options_.demands || (callerDepth > 1 && !frame.modal))
    return;
  const TermId modalCall =
      programs_.hasModalCalls() ? mayCallModally(interpretation_, state, frame.modalLimit).term : store_.no();
  const Callee &callee = frame.callee;
  const Callee &own = path.frames.front().callee;
  const bool isInside = callee.entry != programs_.file(callee.file).cfg.entryOf(callee.program);
  if (isInside && callee.file == own.file && callee.program == own.program)
    return; // M97: a part of the program that is proved
  if (modalCall != store_.no() || isInside || options_.demands(callee))
    result_.calls.push_back({ownPlace(path), frame.callee, path.conditions, state, modalCall});
}

/// Whatever program the call enters, however often, and whatever modal calls are made in it: each entry is asked about
/// as if it were followed.
void Explorer::recordUnmodelledEntries(Path &path, CallRequest<SymbolicInterpretation> request,
                                       std::optional<std::size_t> modal) {
  if (purpose_ != Purpose::Record || !options_.demands)
    return;
  const auto limit = path.frames.back().modalLimit;
  const auto record = [&](const SymbolicFrame &frame, const SymbolicState &state) {
    recordEntry(path, path.frames.size(), frame, state);
  };
  std::vector<Callee> callees = request.possible;
  if (request.callee)
    callees.push_back(*request.callee);
  for (const Callee &callee : callees) {
    request.callee = callee;
    SymbolicState state = path.state;
    SymbolicFrame frame = enterCall(programs_, state, request, {path.at, modal, limit}, 1, interpretation_, record);
    if (repeatsOf(interpretation_, request) == 1.0)
      continue;
    havocParts(interpretation_, state, {}); // by the repetitions before
    repeatCall(programs_, state, frame, interpretation_, record);
  }
  const auto innermost = modalCallOf(path.state, modal ? modal : limit);
  if (!innermost)
    return;
  SymbolicState inside = path.state;
  havocParts(interpretation_, inside, {});
  for (std::size_t i = 0; i <= *innermost; ++i) {
    auto context = contextOf(path);
    const auto modalRequest = prepareModalCall(context, inside.modalCalls[i]);
    SymbolicState state = inside;
    if (modalRequest.callee)
      enterCall(programs_, state, modalRequest, {path.at, i, limit}, 1, interpretation_, record);
  }
}

std::vector<Path> Explorer::enter(Path path, const CallRequest<SymbolicInterpretation> &request,
                                  std::optional<std::size_t> modal) {
  const NodeId next = nodeOf(path).next;
  if (!request.callee && request.number && !request.possible.empty())
    if (const auto callees = byNumber(programs_, request.possible))
      return enterOneOf(path, request, *callees);
  if (!request.callee) {
    const std::string name = nameOfCallee(path, modal);
    const bool returns = request.possible.empty() && !request.isLocal && options_.missing == MissingPrograms::Return;
    if (returns)
      if (auto promised = promisedCall(path, request, modal))
        return *std::move(promised);
    if (returns)
      return missingCall(std::move(path), request, modal, name.empty() ? std::string(kComputedCallee) : name);
    const auto times = repeatsOf(interpretation_, request);
    const bool isCertain = request.possible.empty() && (request.isLocal || options_.missing == MissingPrograms::Stop) &&
                           times && !callsNothing(*times); // with L0 nothing is looked for
    stopsWhen(path, isCertain ? interpretation_.truth(true) : interpretation_.unknownTruth(), missingAlarm(request));
    if (isCertain)
      return takeStops(path), std::vector<Path>{};
    return unknownCall(std::move(path), request, modal, "a program that was not supplied",
                       request.isLocal            ? "the sequence number that is called is unknown"
                       : name.empty()             ? "the number of the called program is unknown"
                       : request.possible.empty() ? fmt::format("{} was not supplied", name)
                                                  : fmt::format("several programs are named {}", name));
  }
  const auto repeats = repeatsOf(interpretation_, request);
  if (repeats && callsNothing(*repeats))
    return {to(std::move(path), next)};
  if (!repeats || *repeats > kMostRepeats) {
    std::string why = fmt::format("how often {} is repeated is unknown", nameOfCallee(path, modal));
    return unknownCall(std::move(path), request, modal, "a call with an unknown number of repetitions", std::move(why));
  }
  const Limits &limits = fileOf(path).dialect->limits;
  if (const auto alarm = nestingAlarm(limits, depthOf(path.frames), request.freshLocals)) {
    stopsWhen(path, interpretation_.truth(true), *alarm);
    takeStops(path);
    return {};
  }
  if (auto promised = promisedCall(path, request, modal))
    return *std::move(promised);
  const CallSite site{path.at, modal, path.frames.back().modalLimit};
  SymbolicFrame frame = enterCall(programs_, path.state, request, site, *repeats, interpretation_,
                                  [&](const SymbolicFrame &entered, const SymbolicState &state) {
                                    recordEntry(path, path.frames.size(), entered, state);
                                  });
  path.frames.push_back(std::move(frame));
  path.at = {request.callee->file, request.callee->entry};
  return {std::move(path)};
}

/// A path for each program that the number may be, and one for all other numbers.
std::vector<Path> Explorer::enterOneOf(const Path &path, const CallRequest<SymbolicInterpretation> &request,
                                       const std::map<std::uint32_t, Callee> &callees) {
  std::vector<Path> paths;
  CallRequest<SymbolicInterpretation> one = request;
  one.number.reset();
  one.possible.clear();
  const auto enterWhere = [&](TermId condition, std::optional<Callee> callee) {
    Path there = path;
    if (!isPossible(path, condition) || !there.assume(store_, condition))
      return;
    one.callee = callee;
    std::ranges::move(enter(std::move(there), one, std::nullopt), std::back_inserter(paths));
  };
  std::vector<TermId> known;
  for (const auto &[number, callee] : callees) {
    known.push_back(store_.equal(request.number->number, interpretation_.number(number).number));
    enterWhere(known.back(), callee);
  }
  enterWhere(store_.logicalNot(store_.logicalOr(known)), std::nullopt);
  return paths;
}

std::vector<Path> Explorer::follow(Path path, const ReturnFromProgram &from) {
  auto context = contextOf(path);
  auto writes = beginWrites(path);
  const auto target = returnTarget(context, from);
  if (!takeStops(path))
    return {};
  if (writes) // the value that is returned
    takeWrites(path, *writes);
  SymbolicFrame &frame = path.frames.back();
  if (path.frames.size() == 1) {
    if (target) {
      if (options_.mayBeCalled)
        exit(path, ExitKind::Returns);
      const BlockId block = nodeOf(path).block;
      return search(std::move(path), *target, block);
    }
    exit(path, ExitKind::Returns);
    return {};
  }
  if (!target && isCalledAgain(frame)) {
    repeatCall(programs_, path.state, frame, interpretation_,
               [&](const SymbolicFrame &entered, const SymbolicState &state) {
                 recordEntry(path, path.frames.size() - 1, entered, state);
               });
    path.at = {frame.callee.file, frame.callee.entry};
    return {std::move(path)};
  }
  return leave(std::move(path), target);
}

std::vector<Path> Explorer::leave(Path path, const std::optional<SymbolicValue> &target) {
  const SymbolicFrame frame = std::move(path.frames.back());
  path.frames.pop_back();
  leaveCall(programs_, path.state, frame);
  path.at = frame.call;
  const Node &caller = nodeOf(path);
  if (target)
    return search(std::move(path), *target, caller.block);
  return {to(std::move(path), caller.next)};
}

} // namespace feedhold::prove
