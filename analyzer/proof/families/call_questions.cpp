// Calls meet the contracts of the programs that they call, whose proofs rest on that.
#include "proof/context/call_promises.h"
#include "proof/families/call_inputs.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace feedhold::prove {

using smt::TermId;

namespace {

std::optional<std::string> brokenByCall(const RunResult &run, const GivenVariables &) {
  if (run.end == RunEnd::Fuel || run.end == RunEnd::Repeats || run.end == RunEnd::Unmodelled)
    return std::nullopt;
  return "the call violates the contract of the program that it calls";
}

std::optional<std::string> neverBroken(const RunResult &, const GivenVariables &) { return std::nullopt; }

/// By block and callee.
using CallKey = std::pair<Place, std::uint32_t>;
CallKey keyOf(const CallInstance &call) { return {call.own, static_cast<std::uint32_t>(call.callee.entry.index())}; }

Question meetsContract(const ProofSubject &subject, Place own, const std::string &callee) {
  return {.row = subject.obligation(ObligationKind::CallMeetsContract, own, subject.spanOf(own),
                                    fmt::format("this call satisfies the contract of {}", callee)),
          .goals = {},
          .broken = brokenByCall,
          .isJudgedExactly = true};
}

/// A program with a contract is entered in a state that the contract allows.
void contractsAreMet(const ExploredProgram &program, Questions &questions) {
  const auto &[subject, start, found] = program;
  smt::TermStore &store = start.store();
  std::map<CallKey, Question> asked;
  for (const CallInstance &call : found.calls) {
    const FileContracts *contracts = subject.contractsOf(call.callee);
    if (!contracts)
      continue;
    ContractTerms terms(start.interpretation(), subject.programs, call.callee.file, *contracts);
    const Contract &contract = *contracts->of(call.callee.program);
    const TermId met = contract.isSound
                           ? store.logicalAnd(demandsOfCall(store, terms, contract, call.state, subject.dialect()))
                           : store.no();
    auto known = asked.find(keyOf(call));
    if (known == asked.end())
      known = asked.emplace(keyOf(call), meetsContract(subject, call.own, subject.nameOf(call.callee))).first;
    known->second.goals.push_back({&call.conditions, met});
  }
  for (auto &[key, question] : asked)
    questions.push_back(std::move(question));
}

/// The same of programs that are in none of the files.  A run does not tell what it passes them; an exact one does.
void missingContractsAreMet(const ExploredProgram &program, Questions &questions) {
  const auto &[subject, start, found] = program;
  std::map<std::pair<Place, std::string>, Question> asked;
  for (const PromisedEntry &entry : found.promised) {
    const std::pair key(entry.own, entry.contract->name());
    auto known = asked.find(key);
    if (known == asked.end())
      known = asked.emplace(key, meetsContract(subject, entry.own, key.second)).first;
    known->second.goals.push_back({&entry.conditions, start.store().logicalAnd(entry.contract->demands(entry.state))});
  }
  for (auto &[key, question] : asked)
    questions.push_back(std::move(question));
}

/// The proofs of a program assume that no modal call is active at its start: its callers answer for that.
void noModalCallIsActive(const ExploredProgram &program, Questions &questions) {
  const auto &[subject, start, found] = program;
  smt::TermStore &store = start.store();
  std::map<std::pair<Place, std::string>, std::vector<PathGoal>> goals; // by block and callee
  for (const CallInstance &call : found.calls)
    if (call.modalCall != store.no())
      goals[{call.own, subject.nameOf(call.callee)}].push_back({&call.conditions, store.logicalNot(call.modalCall)});
  for (auto &[key, parts] : goals) {
    const auto &[place, callee] = key;
    questions.push_back(
        {.row = subject.obligation(ObligationKind::CallMeetsContract, place, subject.spanOf(place),
                                   fmt::format("no modal call is active when {} is called", callee)),
         .goals = std::move(parts),
         .broken = neverBroken,
         .whyOpen = fmt::format(
             "a modal call may be active here, so that each move of {0} calls a macro; the proofs of {0} do "
             "not cover that. Cancel the modal call before this block",
             callee)});
  }
}

/// The proofs of a program start at its first block, and so does the search for stops in its text.
void entriesAreAtHeads(const ExploredProgram &program, Questions &questions) {
  const auto &[subject, start, found] = program;
  std::map<CallKey, Question> asked;
  for (const CallInstance &call : found.calls) {
    const Callee &callee = call.callee;
    if (callee.entry == subject.programs.file(callee.file).cfg.entryOf(callee.program))
      continue;
    asked.try_emplace(
        keyOf(call),
        Question{.row = subject.obligation(ObligationKind::CallMeetsContract, call.own, subject.spanOf(call.own),
                                           fmt::format("{} is entered at its first block", subject.nameOf(callee))),
                 .goals = {},
                 .broken = neverBroken,
                 .open = fmt::format("the call enters {0} at a sequence number; the proofs of {0} start at its first "
                                     "block and do not cover this",
                                     subject.nameOf(callee))});
  }
  for (auto &[key, question] : asked)
    questions.push_back(std::move(question));
}

/// Where paths are missing: the calls in the text that no explored path has reached.
void callsNotMet(const ExploredProgram &program, Questions &questions) {
  const auto &[subject, start, found] = program;
  if (!found.incomplete)
    return;
  const auto &calls = subject.file().model->calls;
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const auto callee = subject.programs.callee(subject.program.file, CallId(i));
    if (calls[CallId(i)].caller != subject.program.program || !callee || !subject.contractsOf(*callee))
      continue;
    const Place own{subject.program.file, subject.file().cfg.nodeOf(calls[CallId(i)].block)};
    Question question = meetsContract(subject, own, subject.nameOf(*callee));
    const bool isMet = std::any_of(questions.begin(), questions.end(),
                                   [&](const Question &other) { return isSameClaim(other.row, question.row); });
    if (!isMet)
      questions.push_back(std::move(question));
  }
}

} // namespace

Questions callQuestions(const ExploredProgram &program) {
  Questions questions;
  if (!program.subject.wants(ObligationKind::CallMeetsContract))
    return questions;
  contractsAreMet(program, questions);
  missingContractsAreMet(program, questions);
  noModalCallIsActive(program, questions);
  entriesAreAtHeads(program, questions);
  callsNotMet(program, questions);
  std::ranges::move(inputQuestions(program), std::back_inserter(questions));
  return questions;
}

} // namespace feedhold::prove
