// Settles a question: by a sampled run, by proofs of all its goals, or by the replay of a counterexample.
#include "proof/context/followed_run.h"
#include "proof/replay/example_run.h"
#include "proof/space/contract_numbers.h"
#include "proof/space/plain_space.h"

#include <algorithm>

namespace feedhold::prove {

namespace {

/// A run in the machine's own numbers, with words as they are written, breaks the promise by more than these round.
bool breaksByFar(const ProofContext &context, const Ensure &promise, const GivenVariables &given) {
  const auto &[subject, start, found] = static_cast<const ExploredProgram &>(context);
  const RunResult run = context.witnesses.runOf(given, WordRounding::None);
  if (!hasEnded(run.end) || run.passedUnmodelled || context.witnesses.passesPromised(run) ||
      context.witnesses.agreesExactly(given, run) == Agreement::Different)
    return false;
  ContractNumbers numbers(subject.programs, subject.program, *subject.contracts, context.witnesses.runOptions(given));
  return numbers.isClearlyBroken(promise, run, toleranceOf(*subject.contract(), subject.dialect()).toDouble());
}

Violation violationOf(const ProofContext &context, const Question &question) {
  Violation violation{question.broken};
  violation.ofBlock = question.ofBlock;
  if (question.isJudgedExactly)
    violation.breaksExactly = [&context, promise = question.promise, row = question.row](const GivenVariables &given) {
      return context.promises.breaks(given, row) || (promise != nullptr && breaksByFar(context, *promise, given));
    };
  return violation;
}

Denial denialOf(const Question &question) {
  const Question claim{.row = question.row,
                       .goals = {},
                       .broken = question.broken,
                       .isJudgedExactly = question.isJudgedExactly,
                       .ofBlock = question.ofBlock,
                       .promise = question.promise};
  return {question.row, [claim](const ProofContext &context) { return violationOf(context, claim); }};
}

Query queryOf(ProofStart &start, const PathGoal &goal) {
  if (!goal.stops)
    return start.onPath(*goal.conditions, goal.goal);
  std::vector<smt::TermId> conditions = *goal.conditions;
  conditions.push_back(*goal.stops);
  return start.onPath(conditions, goal.goal);
}

/// Discharges the goals in turn: collects the proofs, or why one failed.
class Answer {
public:
  Answer(const ProofContext &context, const Violation &violation, std::uint64_t &effort)
      : context_(context), violation_(violation), effort_(effort) {}

  Verdict of(const std::vector<PathGoal> &goals) {
    for (const PathGoal &goal : goals) {
      const Budget left = context_.budget.without(effort_);
      if (witness_)
        break;
      if (effort_ > 0 && left.search == 0) { // the goals that are left are not asked
        if (!open_)
          open_ = verdict::Unknown{.reason = "gave up: the budget for this claim is used up"};
        break;
      }
      take(discharge(context_.start.store(), queryOf(context_.start, goal), left));
    }
    if (witness_)
      return *std::move(witness_);
    if (open_)
      return *std::move(open_);
    return verdict::Proved{.proof = std::move(proof_)};
  }

private:
  void take(Outcome outcome) {
    effort_ += outcome.effort;
    if (outcome.proved())
      return proof_.add(std::move(outcome));
    if (!open_)
      open_ = verdict::Unknown{};
    if (const smt::Model *model = outcome.counterexample()) {
      witness_ = context_.witnesses.fromModel(*model, violation_);
      if (!witness_)
        open_->reason = context_.witnesses.whyNotShown(*model);
    } else if (const auto *unknown = std::get_if<Unknown>(&outcome.answer)) {
      open_->reason = unknown->reason;
    }
  }

  const ProofContext &context_;
  const Violation &violation_;
  std::uint64_t &effort_;
  Proof proof_;
  std::optional<verdict::Unknown> open_;
  std::optional<Witness> witness_;
};

/// Without a contract no claim speaks of the path, but for the alarms of cutter compensation.
bool asksForMoves(const ProofSubject &subject) {
  return subject.contract() != nullptr || subject.programs.mayCompensate();
}

} // namespace

WitnessSearch sampledRuns(const ProofSubject &subject, ProofStart &start, std::vector<smt::TermId> demands) {
  WitnessSearch runs(start.interpretation(), subject.programs, subject.program, std::move(demands),
                     subject.constants());
  RunOptions options = start.runStart();
  options = followedAsSaid(subject.programs, subject.program, subject.contracts, std::move(options));
  options.missing = subject.options.missing;
  options.moves = asksForMoves(subject) ? RecordMoves::Yes : RecordMoves::No;
  runs.startFrom(std::move(options), start.place(), start.openStart(subject.dialect()));
  std::set<std::string> promised;
  for (const auto &[number, contracts] : subject.options.missingContracts)
    promised.insert(toString(ProgramName{.number = number, .text = {}}));
  runs.notThrough(std::move(promised));
  runs.followExactly([&subject](const GivenVariables &given) {
    return FollowedRun(subject, given, Arithmetic::Exact, Outcomes::Usual).found();
  });
  runs.readOffsets([&start](const smt::Model &model) { return start.offsetsIn(model); });
  runs.sample();
  return runs;
}

std::optional<Verdict> decidedBefore(const ProofContext &context, const Violation &violation) {
  if (auto witness = context.witnesses.amongSamples(violation))
    return Verdict(*std::move(witness));
  if (context.found.incomplete)
    return Verdict::unknown(std::string(*context.found.incomplete));
  return std::nullopt;
}

const Obligation *ProofContext::decidedAs(const Obligation &claim) const {
  if (!decided)
    return nullptr;
  const auto known = std::ranges::find_if(
      *decided, [&](const Obligation &row) { return isSameClaim(row, claim) && row.verdict != Verdict::Unknown; });
  return known == decided->end() ? nullptr : &*known;
}

std::vector<Query> queriesOf(ProofStart &start, const Question &question) {
  std::vector<Query> queries;
  for (const PathGoal &goal : question.goals)
    queries.push_back(queryOf(start, goal));
  return queries;
}

namespace {

/// In the words of the exact run.
void sayHowBroken(const ProofContext &context, const Question &question, Obligation &row) {
  const Witness *witness = row.verdict.witness();
  if (!witness || !question.isJudgedExactly)
    return;
  if (std::string how = context.promises.howBroken(witness->variables, row); !how.empty()) {
    Witness shown = *witness;
    shown.happened = std::move(how);
    row.verdict = std::move(shown);
  }
}

/// Absent: no sampled run breaks what is assumed.
std::optional<Obligation> toldByRuns(const ProofContext &context, const Question &question) {
  auto witness = context.witnesses.amongSamples(violationOf(context, question));
  if (!witness)
    return std::nullopt;
  Obligation row = question.row;
  row.verdict = *std::move(witness);
  sayHowBroken(context, question, row);
  return row;
}

} // namespace

namespace {

/// What is told without a question to a solver.
std::optional<Verdict> toldAtOnce(const ProofContext &context, const Question &question) {
  return question.open.empty() ? decidedBefore(context, violationOf(context, question))
                               : Verdict::unknown(question.open);
}

Obligation settle(const ProofContext &context, const Question &question, std::optional<Verdict> told) {
  Obligation row = question.row;
  if (!question.open.empty()) {
    row.verdict = *std::move(told);
    return row;
  }
  const Violation violation = violationOf(context, question);
  if (told)
    row.verdict = *std::move(told);
  else if (question.goals.empty())
    row.verdict = verdict::Unreachable{};
  else
    row.verdict = Answer(context, violation, row.effort).of(question.goals);
  const bool isRounded = context.subject.options.arithmetic != Arithmetic::Exact;
  if (row.verdict == Verdict::Unknown && isRounded && question.isJudgedExactly)
    if (auto witness = context.witnesses.amongDecimals(violation))
      row.verdict = *std::move(witness);
  sayHowBroken(context, question, row);
  if (row.verdict == Verdict::Unknown && !question.whyOpen.empty())
    row.verdict = Verdict::unknown(question.whyOpen);
  return row;
}

} // namespace

Obligation settle(const ProofContext &context, const Question &question) {
  return settle(context, question, toldAtOnce(context, question));
}

/// What is told at once is asked first: solvers may leave no steps for it.
void settleAll(const ProofContext &context, Questions questions, SettledRows &into) {
  std::vector<std::optional<Verdict>> told;
  for (const Question &question : questions)
    told.push_back(question.isToldByRuns || context.decidedAs(question.row) ? std::nullopt
                                                                            : toldAtOnce(context, question));
  for (std::size_t i = 0; i < questions.size(); ++i) {
    Question &question = questions[i];
    if (question.isToldByRuns) {
      if (auto row = toldByRuns(context, question))
        into.rows.push_back(*std::move(row));
      continue;
    }
    into.denials.push_back(denialOf(question));
    const Obligation *known = context.decidedAs(question.row);
    into.rows.push_back(known ? *known : settle(context, question, std::move(told[i])));
    if (!into.rows.back().verdict.holds()) {
      question.row = into.rows.back();
      into.open.push_back(std::move(question));
    }
  }
}

} // namespace feedhold::prove
