// Calls that a contract stands for: the program is not in the files, or its text is not followed.
#include "meaning/cfg/returning.h"
#include "proof/explore/explorer.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::prove {

using smt::TermId;

namespace {

/// A call of the program as a whole, at its head.
bool isPlainCall(CallKind kind) {
  return kind == CallKind::Macro || kind == CallKind::Subprogram || kind == CallKind::Code || kind == CallKind::OWord;
}

} // namespace

/// Null: none says what the call does.  Not of modal calls and repetitions, of which a contract tells one entry alone;
/// nor while a modal call may be made by the movements of the program, or a mapping changes what its coordinates mean.
std::shared_ptr<CalledContract> Explorer::contractFor(const Path &path,
                                                      const CallRequest<SymbolicInterpretation> &request,
                                                      std::optional<std::size_t> modal) {
  const auto *node = std::get_if<CallProgram>(&nodeOf(path).instruction);
  if (!options_.contracts || modal || !node || options_.missing != MissingPrograms::Return)
    return nullptr;
  const Call &call = fileOf(path).model->calls[node->call];
  const auto limit = path.frames.back().modalLimit;
  if (!isPlainCall(call.kind) || programs_.startsInside(path.at.file, call) ||
      repeatsOf(interpretation_, request) != 1.0 || path.state.transformed.term != store_.no() ||
      mayCallModally(interpretation_, path.state, limit).term != store_.no())
    return nullptr;
  if (request.callee && !mayStandFor(path, request))
    return nullptr;
  return options_.contracts(path.at.file, call, request.callee);
}

/// Not for a program that may come to the one that is proved: to rely on it would be to rely on itself.
bool Explorer::mayStandFor(const Path &path, const CallRequest<SymbolicInterpretation> &request) {
  if (options_.relyOn != Reliance::Called)
    return false;
  const auto [known, isNew] = mayStandFor_.try_emplace(*request.callee);
  if (isNew)
    known->second = !mayReach(request, path.frames.front().callee) && returnsBehindItsCall(programs_, *request.callee);
  return known->second;
}

/// As the program finds it.
SymbolicState Explorer::enteredState(const Path &path, const CallRequest<SymbolicInterpretation> &request) {
  SymbolicState entered = path.state;
  if (request.freshLocals)
    entered.locals = request.locals;
  for (const std::uint32_t name : programs_.localNames())
    entered.variables.set(name, interpretation_.vacant());
  return entered;
}

/// As the program leaves it: its own variables hold anything, and are those of the caller where it has none.
SymbolicState Explorer::returnedState(const Path &path, const CallRequest<SymbolicInterpretation> &request) {
  SymbolicState returned = path.state;
  if (request.freshLocals)
    for (std::size_t local = 1; local < returned.locals.size(); ++local)
      returned.locals[local] = interpretation_.anything();
  for (const std::uint32_t name : programs_.localNames())
    returned.variables.set(name, interpretation_.anything());
  return returned;
}

/// Absent: the contract says nothing here, or it is not shown that the call satisfies it.
std::optional<std::vector<Path>> Explorer::promisedCall(const Path &path,
                                                        const CallRequest<SymbolicInterpretation> &request,
                                                        std::optional<std::size_t> modal) {
  std::shared_ptr<CalledContract> contract = contractFor(path, request, modal);
  if (!contract)
    return std::nullopt;
  auto paths = pathsBehind(path, request, std::move(contract));
  path_ = &path; // the path behind the call is gone
  return paths;
}

std::optional<std::vector<Path>> Explorer::pathsBehind(const Path &path,
                                                       const CallRequest<SymbolicInterpretation> &request,
                                                       std::shared_ptr<CalledContract> contract) {
  const bool isMissing = !request.callee;
  Path behind = path;
  contextOf(behind);
  const SymbolicState entered = enteredState(behind, request);
  if (isMissing && purpose_ == Purpose::Record && path.frames.size() == 1)
    result_.promised.push_back({ownPlace(path), contract, path.conditions, entered});
  if (options_.relyOn == Reliance::Nobody || options_.missingChangeNothing ||
      !proves(store_.logicalAnd(contract->demands(entered))))
    return std::nullopt;
  auto context = contextOf(behind);
  loseCutter(behind, "cutter compensation through a call that is not followed");
  havocCall(context, request, "a call that is taken as the contract of its program says");
  behind.state.modalCallsUnknown = path.state.modalCallsUnknown;
  contract->keep(path.state, behind.state);
  if (!takeStops(behind)) // before the contract is read on: the movement belongs to the step
    return std::nullopt;
  const std::vector<TermId> promises = contract->promises(entered, returnedState(behind, request));
  if (!isPossible(behind, store_.logicalAnd(promises))) // such a contract would prove anything
    return std::nullopt;
  if (!isMissing) {
    const SymbolicFrame frame{.callee = *request.callee, .call = path.at, .modalLimit = path.frames.back().modalLimit};
    recordEntry(path, path.frames.size(), frame, entered);
  }
  recordPromisedCall(path, *contract, isMissing);
  for (const TermId promise : promises)
    if (!behind.assume(store_, promise))
      return std::vector<Path>{};
  const NodeId next = nodeOf(behind).next;
  return std::vector<Path>{to(std::move(behind), next)};
}

void Explorer::recordPromisedCall(const Path &path, CalledContract &contract, bool isMissing) {
  const std::string &name = contract.name();
  const auto written = contract.written();
  recordUnmodelledCall(path, {.own = ownPlace(path),
                              .conditions = path.conditions,
                              .loops = {},
                              .why = fmt::format("{} is taken as its contract says", name),
                              .returning = isMissing ? name : std::string(),
                              .promising = name,
                              .tellsWrites = written.has_value()});
  if (options_.keepWrites && purpose_ == Purpose::Record && written)
    for (const std::uint32_t variable : *written)
      result_.writes.push_back({path.at, path.conditions, store_.no(), variable});
}

} // namespace feedhold::prove
