#include "proof/prove/prove.h"

#include "proof/context/call_promises.h"
#include "proof/families/families.h"
#include "proof/guards/guard_inference.h"
#include "proof/obligation/obligation_kinds.h"
#include "proof/prove/judge.h"
#include "proof/relations/loop_relations.h"
#include "proof/smt/steps.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace feedhold::prove {

namespace {

/// One exploration and the verdicts that come of it.
struct Stage {
  Exploration found;
  LoopEnds ends = {};
  SettledRows settled = {};
};

/// By kind, then by place; names that several have are numbered.
void putInOrder(std::vector<Obligation> &rows) {
  std::stable_sort(rows.begin(), rows.end(), [](const Obligation &a, const Obligation &b) {
    return std::pair(a.kind, a.span.begin) < std::pair(b.kind, b.span.begin);
  });
  std::map<std::string, int> names;
  for (Obligation &row : rows)
    if (const int number = ++names[row.id]; number > 1)
      row.id += fmt::format(".{}", number);
}

class Work {
public:
  explicit Work(const ProofSubject &subject)
      : subject_(subject), start_(subject), promises_(subject, promiseQuestions), stage_(std::make_unique<Stage>()) {
    const ExploreOptions options = start_.exploreOptions(subject);
    stage_->found = explore(start_.interpretation(), subject.programs, subject.program, start_.entry(), options);
    witnesses_.emplace(sampledRuns(subject, start_, start_.demands()));
    if (subject.contract())
      sampleContract();
    else {
      witnesses_->sampleOtherModes();
      witnesses_->sampleVariants();
      witnesses_->sampleDecimals({});
    }
    witnesses_->sampleSignals();
    witnesses_->sampleSkips();
  }

  ProgramProof run() {
    settleQuickly(*stage_);
    settleStage(*stage_);
    if (auto guarded = guardedRow(contextOf(*stage_))) // of other calls, which are explored apart
      stage_->settled.rows.push_back(*std::move(guarded));
    followIterations();
    searchWidely();
    std::vector<Obligation> &rows = stage_->settled.rows;
    requireSomeCall(rows);
    if (subject_.options.arithmetic == Arithmetic::Exact) {
      markRounding(contextOf(*stage_), rows);
      refuteByRounding(contextOf(*stage_), stage_->settled.denials, rows);
    }
    const bool isOfTextsAlone = !stage_->found.reliesOnContracts();
    if (subject_.options.guards == InferGuards::Yes && subject_.options.arithmetic == Arithmetic::Exact &&
        isOfTextsAlone)
      addGuards(contextOf(*stage_), stage_->settled.open, rows);
    nameAssumed(rows, stage_->found);
    relyOnContracts();
    putInOrder(rows);
    std::vector<Contradiction> contradictions = judge(contextOf(*stage_), stage_->settled.denials, rows);
    if (subject_.contract() && !subject_.contract()->isSound)
      withdraw(rows, "a clause of the contract could not be read; `feedhold check` reports it");
    return {std::move(rows), std::move(stage_->found.unmodelled), stage_->found.incomplete, std::move(contradictions)};
  }

  /// One more run is held against the verdicts, and refutes what is open.
  void hold(const GivenVariables &given, ProgramProof &proof) {
    const WitnessSearch::Sample run{given, witnesses_->runOf(given)};
    refute(contextOf(*stage_), stage_->settled.denials, run, proof.obligations);
    nameSkipped(proof.obligations);
    std::ranges::move(judgeRun(contextOf(*stage_), stage_->settled.denials, run, proof.obligations),
                      std::back_inserter(proof.contradictions));
  }

  /// The missing programs that are taken to return.
  std::set<std::string> returning() const { return namesIn(stage_->found, &UnmodelledCall::returning); }

private:
  ProofContext contextOf(Stage &stage) {
    return {{subject_, start_, stage.found},
            *witnesses_,
            promises_,
            stage.ends,
            anyCall_ ? &*anyCall_ : nullptr,
            subject_.options.budget,
            &stage != stage_.get() ? &stage_->settled.rows
            : quick_.empty()       ? nullptr
                                   : &quick_};
  }

  void sampleContract() {
    anyCall_ = discharge(start_.store(), start_.onPath(start_.demands(), start_.store().no()), subject_.options.budget);
    if (const smt::Model *model = anyCall_->counterexample())
      witnesses_->sampleAround(*model);
    const std::vector<InputEnds> ends = start_.terms().inputEnds(*subject_.contract(), start_.entry());
    witnesses_->sampleEnds(ends);
    witnesses_->sampleOffsetEnds(start_.terms().offsetEnds(*subject_.contract(), start_.entry()));
    witnesses_->sampleOtherModes();
    witnesses_->sampleDecimals(ends);
  }

  /// A claim that takes long leaves steps for those that do not: what a tenth of the budget decides is decided first.
  /// With a contract, by certificates alone: what solvers show in that time may be certified with all of the budget.
  void settleQuickly(Stage &stage) {
    ProofContext context = contextOf(stage);
    context.budget = context.budget.part(10);
    if (subject_.contract())
      context.budget.z3 = context.budget.cvc5 = 0;
    SettledRows settled;
    settleIn(context, settled);
    quick_ = std::move(settled.rows);
  }

  void settleStage(Stage &stage) { settleIn(contextOf(stage), stage.settled); }

  /// Loops and the end of the program come first: many claims rest on them, and they need few of the steps that all
  /// share.
  static void settleIn(const ProofContext &context, SettledRows &settled) {
    settleLoops(context, settled);
    settleEnd(context, settled);
    settleAll(context, stopQuestions(context), settled);
    settleAll(context, unmetAlarms(context), settled);
    settleAll(context, promiseQuestions(context), settled);
    for (Obligation &row : settled.rows)
      if (row.kind == ObligationKind::AlarmIff && !context.decidedAs(row))
        requireEnds(context, row);
    settleSpace(context, settled);
  }

  void followIterations();
  void searchWidely();
  void relyOnContracts();
  void takeOver(Stage &promised);
  Exploration exploreWidely();
  void settleAgain(Stage &stage, const std::string &method);
  void goOnWith(std::unique_ptr<Stage> stage);

  static std::set<std::string> namesIn(const Exploration &found, std::string UnmodelledCall::*name) {
    std::set<std::string> names;
    for (const UnmodelledCall &call : found.unmodelledCalls)
      if (!(call.*name).empty())
        names.insert(call.*name);
    return names;
  }
  /// The programs that are taken to do what their contracts say.
  static std::set<std::string> promisingIn(const Exploration &found) {
    return namesIn(found, &UnmodelledCall::promising);
  }

  /// What a verdict takes other programs to do: for all runs of the exploration, or in the run of the witness.
  void nameAssumed(std::vector<Obligation> &rows, const Exploration &found) const {
    const std::set<std::string> names = namesIn(found, &UnmodelledCall::returning), promising = promisingIn(found);
    for (Obligation &row : rows)
      if (row.verdict.holds()) {
        row.returning.assign(names.begin(), names.end());
        row.promising.assign(promising.begin(), promising.end());
        row.offsetIsOfTool = row.kind == ObligationKind::Compensation && takesOffsetOfTool();
      }
    nameSkipped(rows);
  }
  /// No clause tells the offsets of D.  On a lathe they are those of the nose.
  bool takesOffsetOfTool() const {
    const Contract *contract = subject_.contract();
    return contract && contract->tool && contract->offsets.empty() &&
           subject_.dialect().machine != MachineKind::Turning;
  }
  void nameSkipped(std::vector<Obligation> &rows) const {
    if (returning().empty())
      return;
    for (Obligation &row : rows)
      if (const Witness *witness = row.verdict.witness())
        row.verdict.setReturning(witnesses_->runOf(witness->variables).skipped);
  }

  /// A contract that no call satisfies would make everything true.
  void requireSomeCall(std::vector<Obligation> &rows) const {
    if (!anyCall_ || !anyCall_->proved())
      return;
    for (Obligation &row : rows)
      if (row.verdict.holds())
        row.verdict = Verdict::unknown("no call satisfies the contract");
    Obligation none =
        subject_.obligation(ObligationKind::ContractSatisfiable, "at least one call satisfies this contract");
    none.verdict = verdict::Refuted{
        .shownBy = verdict::Refuted::NoCall{"no call satisfies this contract: its clauses contradict each other"}};
    rows.push_back(std::move(none));
  }

  /// A contract with an unreadable clause may not say what its author meant.
  static void withdraw(std::vector<Obligation> &rows, const std::string &reason) {
    for (Obligation &row : rows)
      row.verdict = Verdict::unknown(reason);
  }

  const ProofSubject &subject_;
  ProofStart start_;
  BrokenPromises promises_;
  std::unique_ptr<Stage> stage_;
  std::vector<Obligation> quick_; // of settleQuickly()
  std::optional<WitnessSearch> witnesses_;
  std::optional<Outcome> anyCall_;
};

bool isOpen(const Obligation &row) { return row.verdict == Verdict::Unknown; }

/// No path stops at the place, and all paths have been followed to their end.  A run that comes to `#3000=` stops
/// there, so that no run comes to it; one that comes to a block where a control may stop does not always do so. Nothing
/// is asked of a call to which no path comes, or of which what is asked is plain.
Obligation notMet(Obligation row, const std::string &method) {
  if (isOpen(row) && row.kind == ObligationKind::AlarmUnreachable)
    row.verdict = verdict::Unreachable{.method = method};
  if (isOpen(row) && (row.kind == ObligationKind::NoControlAlarm || row.kind == ObligationKind::CallMeetsContract))
    row.verdict = verdict::Proved{.proof = {.method = method}};
  return row;
}

/// The verdicts on both sides; what was decided before stays.
void keepDecided(const std::vector<Obligation> &before, std::vector<Obligation> &rows, const std::string &method) {
  for (Obligation &now : rows) {
    const auto known =
        std::find_if(before.begin(), before.end(), [&](const Obligation &old) { return isSameClaim(old, now); });
    if (known != before.end() && !isOpen(*known))
      now = *known;
  }
  for (const Obligation &old : before)
    if (std::none_of(rows.begin(), rows.end(), [&](const Obligation &now) { return isSameClaim(old, now); }))
      rows.push_back(notMet(old, method));
}

/// Claims that are open after one symbolic iteration stood for all: where all loops have few iterations, they are
/// unrolled.
void Work::followIterations() {
  const Exploration &found = stage_->found;
  const std::vector<Obligation> &before = stage_->settled.rows;
  const bool hasLoops = !found.loops.empty() || found.incomplete;
  if (!hasLoops || found.callWithoutReturn() || std::none_of(before.begin(), before.end(), isOpen))
    return;
  ExploreOptions options = start_.exploreOptions(subject_);
  options.loops = LoopTreatment::EachIteration;
  options.mostSteps = 8'000;
  options.mostPaths = 100;
  options.mostWork = 200'000;
  options.mostTerms = 100'000;
  auto each = std::make_unique<Stage>();
  each->found = explore(start_.interpretation(), subject_.programs, subject_.program, start_.entry(), options);
  if (each->found.incomplete || each->found.callWithoutReturn())
    return;
  settleAgain(*each, "loop unrolling");
  goOnWith(std::move(each));
}

/// Settles what another exploration of all paths has found, and keeps what was decided before it.
void Work::settleAgain(Stage &stage, const std::string &method) {
  settleStage(stage);
  keepDecided(stage_->settled.rows, stage.settled.rows, method);
}

void Work::goOnWith(std::unique_ptr<Stage> stage) {
  std::ranges::move(stage_->settled.denials, std::back_inserter(stage->settled.denials));
  stage_ = std::move(stage);
}

/// The iterations of a loop change what an open claim speaks of; of some loop nothing but bounds is known.
bool mayDependOnLoops(const smt::TermStore &store, const Exploration &found, const SettledRows &settled) {
  std::set<smt::TermId> changed;
  for (const LoopInstance &loop : found.loops)
    if (loop.isRecorded && !loop.variables.empty()) {
      changed.insert(loop.variables.begin(), loop.variables.end());
      changed.insert(loop.iterations);
    }
  const auto speaksOfLoops = [&](smt::TermId term) {
    return std::ranges::any_of(smt::variablesOf(store, term),
                               [&](smt::TermId variable) { return changed.contains(variable); });
  };
  const auto isOfLoops = [&](const PathGoal &goal) {
    return speaksOfLoops(goal.goal) || (goal.stops && speaksOfLoops(*goal.stops)) ||
           std::ranges::any_of(*goal.conditions, speaksOfLoops);
  };
  return !changed.empty() && (std::ranges::any_of(settled.rows,
                                                  [](const Obligation &row) {
                                                    return isOpen(row) && (row.kind == ObligationKind::LoopEnds ||
                                                                           row.kind == ObligationKind::ProgramEnds);
                                                  }) ||
                              std::ranges::any_of(settled.open, [&](const Question &question) {
                                return isOpen(question.row) && std::ranges::any_of(question.goals, isOfLoops);
                              }));
}

/// Claims that are still open: the program is explored once more, with relations that runs and these claims suggest as
/// invariants of its loops, and with more guesses of its own.  What that finds is used where it decides a claim.
void Work::searchWidely() {
  constexpr std::uint64_t kMostWork = 1'500'000;   // of a program that is explored twice
  constexpr std::uint64_t kMostSteps = 40'000'000; // about 0.4 seconds; guards are searched for with what is left
  const Exploration &found = stage_->found;
  const bool isOneSymbolicIteration = found.treatment == LoopTreatment::AnyIteration && !found.incomplete;
  if (!isOneSymbolicIteration || found.work > kMostWork || found.callWithoutReturn() ||
      !mayDependOnLoops(start_.store(), found, stage_->settled))
    return;
  const smt::Steps share(std::min(kMostSteps, smt::stepsLeft() / 4), smt::Steps::AtEnd::GoOn);
  auto wide = std::make_unique<Stage>();
  wide->found = exploreWidely();
  if (wide->found.incomplete || wide->found.callWithoutReturn())
    return;
  settleAgain(*wide, "loop invariants");
  if (std::ranges::count_if(wide->settled.rows, isOpen) < std::ranges::count_if(stage_->settled.rows, isOpen))
    goOnWith(std::move(wide));
}

Exploration Work::exploreWidely() {
  LoopRelations relations;
  const ProofContext context = contextOf(*stage_);
  addRelationsOfRuns(context, relations);
  addRelationsOfGoals(context, stage_->settled.open, relations);
  ExploreOptions options = start_.exploreOptions(subject_);
  options.search = InvariantSearch::Wide;
  options.merging = stage_->found.merging;
  options.invariants = [&, before = options.invariants](Place head, const SymbolicState &state) {
    std::vector<smt::TermId> all = relations.in(start_.store(), head, state);
    if (before)
      std::ranges::move(before(head, state), std::back_inserter(all));
    return all;
  };
  return explore(start_.interpretation(), subject_.programs, subject_.program, start_.entry(), options);
}

/// Claims that are open where the texts of called programs are followed: they are asked once more with their contracts
/// in the place of the texts.  The verdicts say so, and everything else goes on with what the texts have shown.
void Work::relyOnContracts() {
  constexpr std::uint64_t kMostSteps = 100'000'000;
  std::vector<Obligation> &rows = stage_->settled.rows;
  const bool someCall = !anyCall_ || !anyCall_->proved();
  if (subject_.options.missing != MissingPrograms::Return || !someCall || std::ranges::none_of(rows, isOpen) ||
      !callsPromising(subject_))
    return;
  const smt::Steps share(std::min(kMostSteps, smt::stepsLeft() / 3), smt::Steps::AtEnd::GoOn);
  ExploreOptions options = start_.exploreOptions(subject_);
  options.relyOn = Reliance::Called;
  Stage promised;
  promised.found = explore(start_.interpretation(), subject_.programs, subject_.program, start_.entry(), options);
  if (promised.found.incomplete || !promised.found.reliesOnContracts())
    return;
  settleStage(promised);
  nameAssumed(promised.settled.rows, promised.found);
  takeOver(promised);
}

/// What was open and is decided now; and what was never come to, if paths were missing.
void Work::takeOver(Stage &promised) {
  std::vector<Obligation> &rows = stage_->settled.rows, &others = promised.settled.rows;
  for (Obligation &row : rows) {
    if (!isOpen(row))
      continue;
    const auto same = std::ranges::find_if(others, [&](const Obligation &other) { return isSameClaim(row, other); });
    std::vector<Obligation> decided{same == others.end() ? notMet(row, "contracts of called programs") : *same};
    if (same == others.end())
      nameAssumed(decided, promised.found);
    if (!isOpen(decided.front()))
      row = std::move(decided.front());
  }
  if (!stage_->found.incomplete)
    return;
  for (Obligation &other : others)
    if (std::ranges::none_of(rows, [&](const Obligation &row) { return isSameClaim(row, other); }))
      rows.push_back(std::move(other));
  std::ranges::move(promised.settled.denials, std::back_inserter(stage_->settled.denials));
}

bool isByRounding(const Obligation &exact) {
  const Witness *witness = exact.verdict.witness();
  return (exact.verdict.holds() && exact.promising.empty()) || (witness && witness->happened.ends_with(kByRounding));
}

constexpr std::string_view kRoundingMayBreak = "holds in exact arithmetic; rounding on the control may break it";

/// An arc that is rounded is no longer tangent to the line beside it.
std::string whyRounded(const Obligation &row, const Contract *contract) {
  const bool mayTakeSteps = row.kind == ObligationKind::Compensation && contract &&
                            std::ranges::any_of(contract->params, [](const EntryValue &param) {
                              return !param.step && param.unit != Unit::Integer;
                            });
  return std::string(kRoundingMayBreak) +
         (mayTakeSteps ? ". `BY .001` behind the ranges of arguments in the contour makes its words exact" : "");
}

/// Holds in exact arithmetic, or would with a guard that was found there.
void takeFromExact(Obligation &row, const Obligation &exact, const Contract *contract) {
  if (const Witness *found = row.verdict.witness(); found && isByRounding(exact)) {
    Witness witness = *found;
    witness.happened += kByRounding;
    row.verdict = std::move(witness);
  }
  if (isOpen(row) && exact.verdict.holds())
    row.verdict = Verdict::unknown(whyRounded(row, contract));
  if (const auto *guard = exact.verdict.guard(); guard && !row.verdict.holds()) {
    Guard known = *guard;
    known.exactOnly = true;
    row.verdict.setGuard(std::move(known));
  }
}

/// A proof, and what it was made of.
struct WholeProof {
  std::unique_ptr<Work> work;
  ProgramProof proof;

  bool meetsMissing() const { return !work->returning().empty(); }
};

/// In the arithmetic of the options, and with all the steps.
WholeProof proveIn(const ProofSubject &subject) {
  const smt::Steps steps(subject.options.steps, smt::Steps::AtEnd::GoOn);
  auto work = std::make_unique<Work>(subject);
  ProgramProof proof = work->run();
  return {std::move(work), std::move(proof)};
}

using Kinds = std::set<ObligationKind>;

ProveOptions withOnly(ProveOptions options, const Kinds &kinds) {
  options.only.assign(kinds.begin(), kinds.end());
  return options;
}

/// What holds but for the rounding of the control says so.  Guards are searched for in exact numbers.
void compareWithExact(const ProofSubject &subject, std::vector<WholeProof> &parts) {
  const bool needsGuards = subject.options.guards == InferGuards::Yes;
  Kinds kinds;
  for (const WholeProof &part : parts)
    for (const Obligation &row : part.proof.obligations)
      if (isOpen(row) || (needsGuards && !row.verdict.holds()))
        kinds.insert(row.kind);
  if (kinds.empty())
    return;
  ProveOptions options = withOnly(subject.options, kinds);
  options.arithmetic = Arithmetic::Exact;
  if (!subject.contract()) // what is open in rounded numbers is mostly open in exact ones
    options.steps /= 3;
  const ProofSubject exact{subject.programs, subject.program, subject.contracts, options};
  ProgramProof inExact = std::move(proveIn(exact).proof);
  for (WholeProof &part : parts) {
    std::vector<Obligation> &rows = part.proof.obligations;
    for (const Obligation &row : inExact.obligations)
      if (const Witness *witness = row.verdict.witness())
        part.work->hold(witness->variables, part.proof);
    for (Obligation &row : rows)
      for (const Obligation &other : inExact.obligations)
        if (isSameClaim(row, other))
          takeFromExact(row, other, subject.contract());
  }
  std::ranges::move(inExact.contradictions, std::back_inserter(parts.front().proof.contradictions));
}

/// That something ends: to take few passes for granted would be to assume it.  Claims about space are proved apart.
bool isAskedOfAllRuns(ObligationKind kind) {
  return std::ranges::find(kSpaceKinds, kind) != kSpaceKinds.end() || kind == ObligationKind::LoopEnds ||
         kind == ObligationKind::ProgramEnds || kind == ObligationKind::AlarmIff || kind == ObligationKind::Guarded ||
         kind == ObligationKind::ContractSatisfiable;
}

/// What rounding may break is proved of runs in which no loop makes so many passes that their count is rounded.
void proveOfFewPasses(const ProofSubject &subject, ProgramProof &proof) {
  const auto isOpenByRounding = [](const Obligation &row) {
    return isOpen(row) && row.verdict.reason().starts_with(kRoundingMayBreak) && !isAskedOfAllRuns(row.kind);
  };
  Kinds kinds;
  for (const Obligation &row : proof.obligations)
    if (isOpenByRounding(row))
      kinds.insert(row.kind);
  if (!subject.options.mayTakeFewPasses || kinds.empty())
    return;
  ProveOptions options = withOnly(subject.options, kinds);
  options.takesFewPasses = true;
  if (!subject.contract())
    options.steps /= 3;
  const ProofSubject few{subject.programs, subject.program, subject.contracts, options};
  ProgramProof found = std::move(proveIn(few).proof);
  for (Obligation &row : proof.obligations)
    for (const Obligation &other : found.obligations)
      if (isOpenByRounding(row) && isSameClaim(row, other) && other.verdict.holds()) {
        row.verdict = other.verdict;
        row.returning = other.returning;
        row.promising = other.promising;
        row.offsetIsOfTool = other.offsetIsOfTool;
        row.takesFewPasses = true;
      }
  std::ranges::move(found.contradictions, std::back_inserter(proof.contradictions));
}

/// Of a proof in which missing programs are taken to return: whether it meets any.
struct ProofWithMissing {
  ProgramProof proof;
  bool meetsMissing;
};

/// Claims about space are proved apart, with the movements of the program: they need much, and take nothing from the
/// others.
ProofWithMissing proveRounded(const ProofSubject &subject) {
  Kinds space, others;
  for (const ObligationKind kind : kObligationKinds)
    if (subject.wants(kind))
      (std::ranges::find(kSpaceKinds, kind) != kSpaceKinds.end() ? space : others).insert(kind);
  const ProveOptions ofOthers = withOnly(subject.options, others), ofSpace = withOnly(subject.options, space);
  const ProofSubject withoutSpace{subject.programs, subject.program, subject.contracts, ofOthers};
  const ProofSubject inSpace{subject.programs, subject.program, subject.contracts, ofSpace};
  const bool asksOfSpace = !space.empty() && subject.contract() && hasSpaceClause(*subject.contract());
  std::vector<WholeProof> parts;
  if (!others.empty() || !asksOfSpace)
    parts.push_back(proveIn(others.empty() ? subject : withoutSpace));
  if (asksOfSpace)
    parts.push_back(proveIn(inSpace));
  compareWithExact(subject, parts);
  proveOfFewPasses(subject, parts.front().proof);
  ProgramProof &whole = parts.front().proof;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    ProgramProof &part = parts[i].proof;
    std::ranges::copy_if(part.obligations, std::back_inserter(whole.obligations),
                         [&](const Obligation &row) { return space.contains(row.kind); });
    std::ranges::move(part.contradictions, std::back_inserter(whole.contradictions));
    if (!whole.incomplete)
      whole.incomplete = std::move(part.incomplete);
  }
  putInOrder(whole.obligations);
  return {std::move(whole), std::ranges::any_of(parts, [](const WholeProof &part) { return part.meetsMissing(); })};
}

ProofWithMissing proveInOptions(const ProofSubject &subject) {
  if (subject.options.arithmetic != Arithmetic::Exact)
    return proveRounded(subject);
  WholeProof whole = proveIn(subject);
  return {std::move(whole.proof), whole.meetsMissing()};
}

/// A missing program may change the counter of a loop around its call, and mostly does not: that something ends is
/// asked again of the runs in which it changes nothing.  Other claims are not: what is read behind a call, such as the
/// result of a probing cycle, the missing program is called to change.
void proveOfUnchanged(const ProofSubject &subject, ProgramProof &proof) {
  const auto isOpenEnd = [](const Obligation &row) {
    return isOpen(row) && (row.kind == ObligationKind::LoopEnds || row.kind == ObligationKind::ProgramEnds);
  };
  Kinds kinds;
  for (const Obligation &row : proof.obligations)
    if (isOpenEnd(row))
      kinds.insert(row.kind);
  if (kinds.empty())
    return;
  ProveOptions options = withOnly(subject.options, kinds);
  options.missingChangeNothing = true;
  options.guards = InferGuards::No;
  if (!subject.contract())
    options.steps /= 3;
  const ProofSubject unchanged{subject.programs, subject.program, subject.contracts, options};
  ProgramProof found = std::move(proveInOptions(unchanged).proof);
  for (Obligation &row : proof.obligations)
    for (const Obligation &other : found.obligations)
      if (isOpenEnd(row) && isSameClaim(row, other) && other.verdict.holds() && !other.returning.empty()) {
        row.verdict = other.verdict;
        row.returning = other.returning;
        row.promising = other.promising;
        row.offsetIsOfTool = other.offsetIsOfTool;
        row.unchanged = true;
      }
  std::ranges::move(found.contradictions, std::back_inserter(proof.contradictions));
}

} // namespace

ProgramProof prove(const ProgramSet &programs, Callee program, const FileContracts *contracts,
                   const ProveOptions &options) {
  const ProofSubject subject{programs, program, contracts, options};
  auto [proof, meetsMissing] = proveInOptions(subject);
  if (meetsMissing && options.missing == MissingPrograms::Return)
    proveOfUnchanged(subject, proof);
  return std::move(proof);
}

} // namespace feedhold::prove
