// Of each entry of another program: that it is one for which that program was proved.
#include "proof/families/families.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::prove {

using smt::TermId;

namespace {

std::optional<std::string> brokenByCall(const RunResult &run, const GivenVariables &) {
  if (run.end == RunEnd::Fuel || run.end == RunEnd::Repeats || run.end == RunEnd::NotModelled)
    return std::nullopt;
  return "the call is made with what that contract does not allow";
}

std::optional<std::string> neverBroken(const RunResult &, const GivenVariables &) { return std::nullopt; }

/// By block and callee.
using CallKey = std::pair<Place, std::uint32_t>;
CallKey keyOf(const CallInstance &call) { return {call.own, static_cast<std::uint32_t>(call.callee.entry.index())}; }

Question meetsContract(const ProofSubject &subject, Place own, const Callee &callee) {
  return {.row = subject.obligation(ObligationKind::CallMeetsContract, own, subject.spanOf(own),
                                    fmt::format("this call satisfies the contract of {}", subject.nameOf(callee))),
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
    ContractTerms terms(start.reading(), subject.programs, call.callee.file, *contracts);
    const Contract &contract = *contracts->of(call.callee.program);
    const TermId met = contract.isSound ? store.logicalAnd(terms.assumptions(contract, call.state)) : store.no();
    auto known = asked.find(keyOf(call));
    if (known == asked.end())
      known = asked.emplace(keyOf(call), meetsContract(subject, call.own, call.callee)).first;
    known->second.goals.push_back({&call.conditions, met});
  }
  for (auto &[key, question] : asked)
    questions.push_back(std::move(question));
}

/// What is proved of a program by itself holds where its movements make no modal call: whoever calls it answers for
/// that.
void noModalCallIsInForce(const ExploredProgram &program, Questions &questions) {
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
                                   fmt::format("no modal call is in force when {} is called", callee)),
         .goals = std::move(parts),
         .broken = neverBroken,
         .whyOpen = fmt::format("the movements of {} call a macro here: its own proofs do not cover that", callee)});
  }
}

/// What is proved of a program by itself begins at its head, and so do the stops that are looked for in its text.
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
                                           fmt::format("{} is entered at its head", subject.nameOf(callee))),
                 .goals = {},
                 .broken = neverBroken,
                 .open = fmt::format("the call enters {} at a sequence number: what is proved of that "
                                     "program by itself does not cover it",
                                     subject.nameOf(callee))});
  }
  for (auto &[key, question] : asked)
    questions.push_back(std::move(question));
}

/// Where paths are missing, the calls in the text that none of the others has come to.
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
    Question question = meetsContract(subject, own, *callee);
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
  noModalCallIsInForce(program, questions);
  entriesAreAtHeads(program, questions);
  callsNotMet(program, questions);
  return questions;
}

} // namespace feedhold::prove
