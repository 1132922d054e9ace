// `@GUARDED`: every call that the contract does not allow raises an alarm before an axis moves.
#include "proof/prove/obligations.h"

#include <algorithm>

namespace feedhold::prove {

namespace {

std::optional<std::string> getsPastGuards(const RunResult &run, const GivenVariables &) {
  const bool moved = std::any_of(run.moves.begin(), run.moves.end(),
                                 [](const RecordedMove &move) { return move.move.kind != MoveKind::Dwell; });
  if (moved)
    return "an axis moves";
  const bool ended = run.end == RunEnd::M02 || run.end == RunEnd::M30 || run.end == RunEnd::Returned;
  return ended ? std::optional<std::string>("the program ends without an alarm") : std::nullopt;
}

/// The modes and the place are those of the contract in all calls that are looked at: the claim says so.  Callers
/// answer for them (`call-meets-contract`).
std::string claimOf(const ProofSubject &subject) {
  const Contract &contract = *subject.contract();
  std::string claim = subject.textOf(*contract.guarded);
  if (!contract.modal.empty())
    claim += " (calls in the modes of @MODAL";
  if (contract.start)
    claim += contract.modal.empty() ? " (calls from the place of @START" : ", from the place of @START";
  return contract.modal.empty() && !contract.start ? claim : claim + ")";
}

Question guardedQuestion(const ExploredProgram &outside) {
  const auto &[subject, start, found] = outside;
  smt::TermStore &store = start.store();
  Question question{
      .row = subject.obligation(ObligationKind::Guarded, claimOf(subject)), .goals = {}, .broken = getsPastGuards};
  for (const PathExit &exit : found.exits)
    question.goals.push_back({&exit.conditions, store.no()});
  for (const Check &check : found.checks)
    for (const CheckInstance &instance : check.instances)
      question.goals.push_back({&instance.conditions, store.logicalNot(instance.moved), instance.stops});
  for (const UnfollowedCall &call : found.unfollowedCalls)
    question.goals.push_back({&call.conditions, store.no()});
  if (found.incomplete)
    question.open = *found.incomplete;
  return question;
}

} // namespace

std::optional<Obligation> guardedRow(const ProofContext &context) {
  const ProofSubject &subject = context.subject;
  ProofStart &start = context.start;
  if (!subject.contract() || !subject.contract()->guarded || !subject.wants(ObligationKind::Guarded))
    return std::nullopt;
  ExploreOptions options;
  options.assumptions = {start.store().logicalNot(start.store().logicalAnd(start.demands()))};
  const Exploration found = explore(start.reading(), subject.programs, subject.program, start.entry(), options);
  WitnessSearch witnesses = sampledRuns(subject, start, options.assumptions);
  if (const smt::Model *model = context.anyCall->counterexample()) // what breaks one clause may keep the others
    witnesses.sampleAround(*model);
  LoopEnds ends;
  const ProofContext outside{{subject, start, found}, witnesses,     context.promises, ends,
                             context.anyCall,         context.budget};
  Obligation row = settle(outside, guardedQuestion(outside));
  requireEnds(outside, row);
  return row;
}

} // namespace feedhold::prove
