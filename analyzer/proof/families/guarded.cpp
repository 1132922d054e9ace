// `@GUARDED`: every call that the contract does not allow raises an alarm before an axis moves.  A call in other modes,
// or from another place, is one of them as much as one with other arguments, unless the clause excepts it.
#include "proof/families/families.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::prove {

using smt::TermId;

namespace {

std::optional<std::string> getsPastGuards(const RunResult &run, const GivenVariables &) {
  const bool moved = std::any_of(run.moves.begin(), run.moves.end(), [](const RecordedMove &move) {
    // an unmodelled block need not move
    return move.move.kind != MoveKind::Dwell && move.move.kind != MoveKind::Unmodelled;
  });
  if (moved)
    return "an axis moves before any alarm";
  const bool ended = run.end == RunEnd::M02 || run.end == RunEnd::M30 || run.end == RunEnd::Returned;
  return ended ? std::optional<std::string>("the program ends without an alarm") : std::nullopt;
}

/// Programs seldom check the modal codes and the position that they find.
std::string whyNotGuarded(const Contract &contract) {
  const bool modes = !contract.modal.empty() && !contract.guarded->exceptModal;
  const bool place = contract.start && !contract.guarded->exceptStart;
  if (!modes && !place)
    return {};
  return fmt::format(
      "calls {}{}{} were not proved to raise an alarm; if the callers rule them out, write `@GUARDED EXCEPT{}{}`",
      modes ? "with other modal codes" : "", modes && place ? " or " : "", place ? "from another start position" : "",
      modes ? " MODAL" : "", place ? " START" : "");
}

Question guardedQuestion(const ExploredProgram &outside) {
  const auto &[subject, start, found] = outside;
  smt::TermStore &store = start.store();
  Question question{
      .row = subject.obligation(ObligationKind::Guarded, subject.textOf(subject.contract()->guarded->clause)),
      .goals = {},
      .broken = getsPastGuards};
  for (const PathExit &exit : found.exits)
    question.goals.push_back({&exit.conditions, store.no()});
  for (const StopSite &stop : found.stopSites)
    for (const StopInstance &instance : stop.instances)
      question.goals.push_back({&instance.conditions, store.logicalNot(instance.moved), instance.stops});
  for (const UnmodelledCall &call : found.unmodelledCalls)
    question.goals.push_back({&call.conditions, store.no()});
  if (found.incomplete)
    question.open = *found.incomplete;
  else
    question.whyOpen = whyNotGuarded(*subject.contract());
  return question;
}

/// While it lives, inputs are not known to be whole numbers or multiples: that is a clause of the contract, too.
class BesideContract {
public:
  explicit BesideContract(SymbolicInterpretation &interpretation)
      : interpretation_(interpretation), before_(interpretation.believeInputs(false)) {}
  BesideContract(const BesideContract &) = delete;
  BesideContract &operator=(const BesideContract &) = delete;
  ~BesideContract() { interpretation_.believeInputs(before_); }

private:
  SymbolicInterpretation &interpretation_;
  bool before_;
};

/// The start of the calls that are looked at, and what makes one of them a call that the contract allows.
struct Outside {
  SymbolicState start;
  std::vector<TermId> allowed;
};

/// What the clause excepts is as the contract says in all of them.
Outside outsideOf(ProofStart &start, const Contract &contract) {
  Outside outside{start.anyEntry(), start.terms().demands(contract, start.anyEntry())};
  const auto demand = [&](std::vector<TermId> more) {
    outside.allowed.insert(outside.allowed.end(), more.begin(), more.end());
  };
  if (contract.guarded->exceptModal)
    outside.start.codes = start.entry().codes;
  else
    demand(start.terms().modesOfStart(contract, start.anyEntry()));
  if (contract.guarded->exceptStart)
    for (const Axis axis : kAllAxes)
      outside.start.at(axis) = start.entry().at(axis);
  else
    demand(start.terms().placeOfStart(contract, start.anyEntry()));
  return outside;
}

} // namespace

std::optional<Obligation> guardedRow(const ProofContext &context) {
  const ProofSubject &subject = context.subject;
  ProofStart &start = context.start;
  if (!subject.contract() || !subject.contract()->guarded || !subject.wants(ObligationKind::Guarded))
    return std::nullopt;
  smt::TermStore &store = start.store();
  const BesideContract anyNumbers(start.interpretation());
  ExploreOptions options;
  const Outside outsideStart = outsideOf(start, *subject.contract());
  options.assumptions = {store.logicalNot(store.logicalAnd(outsideStart.allowed))};
  const Exploration found =
      explore(start.interpretation(), subject.programs, subject.program, outsideStart.start, options);
  // Runs of the machine start as the contract says: they show what its variables do.
  WitnessSearch witnesses = sampledRuns(subject, start, {store.logicalNot(store.logicalAnd(start.demands()))});
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
