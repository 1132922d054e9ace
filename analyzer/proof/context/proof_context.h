// ProofContext: everything that settles an obligation.  A stage that differs in one part, such as an exploration under
// one more condition, has a context of its own.
#pragma once

#include "proof/context/broken_promises.h"
#include "proof/context/proof_start.h"
#include "proof/replay/witness.h"
#include "proof/termination/termination.h"

#include <map>

namespace feedhold::prove {

/// Why the loops of one exploration end, or do not: each found out once.
using LoopEnds = std::map<const LoopInstance *, Termination>;

/// What obligations are made from.
struct ExploredProgram {
  const ProofSubject &subject;
  ProofStart &start; // terms and facts are added to it
  const Exploration &found;
};

struct ProofContext : ExploredProgram {
  const WitnessSearch &witnesses;
  BrokenPromises &promises; // remembers the runs that it has followed
  LoopEnds &ends;
  /// Whether the contract allows no call at all; the counterexample is one.  Null: there is no contract.
  const Outcome *anyCall;
  Budget budget;
  /// Of another exploration of the same program: what these rows say of a claim is not asked again.  Null: there was
  /// none.
  const std::vector<Obligation> *decided = nullptr;

  /// Null: the claim is open.
  const Obligation *decidedAs(const Obligation &claim) const;
};

/// A path and what has to hold at its end.
struct PathGoal {
  const std::vector<smt::TermId> *conditions; // of a path of the exploration
  smt::TermId goal;
  std::optional<smt::TermId> stops = {}; // one more condition
  std::string missedBy = {};             // what a run does that misses it; empty: Question::broken says it
};

/// Runs from the start that the contract says, on plain numbers.
WitnessSearch sampledRuns(const ProofSubject &subject, ProofStart &start, std::vector<smt::TermId> demands);

/// An obligation and what its proof needs: that each goal holds.  Without goals no path comes to its place.
struct Question {
  Obligation row;
  std::vector<PathGoal> goals;
  /// What a run that breaks the claim does.
  Violation::Happened broken;
  /// The run does not show it: whether the claim is broken is decided by an exact run of the program.
  bool isJudgedExactly = false;
  std::optional<Violation::OfBlock> ofBlock = {};
  /// Where an exact run has no answer, what is promised of the state behind a run may still fail there by far.  Null:
  /// it is not of that kind.  Of the contract.
  const Ensure *promise = nullptr;
  /// Why it is not even asked; empty: it is.
  std::string open = {};
  /// What is missing when it is not proved; empty: what the search says.
  std::string whyOpen = {};
  /// An assumption that a sampled run may break.  It is a row only then, and not asked of paths.
  bool isToldByRuns = false;
};
using Questions = std::vector<Question>;

/// What a run does that denies a claim, whatever the verdict is: for the judge (judge.h).
struct Denial {
  Obligation row;
  std::function<Violation(const ProofContext &)> violation;
  /// Of a claim about space: the witness with the place of the gouge; empty: it has none.
  std::function<Witness(const ProofContext &, Witness)> located = {};
};

/// Obligations with their verdicts, and the questions of which the answer was not found: `[i]` of `rows`.
struct SettledRows {
  std::vector<Obligation> rows;
  std::vector<Question> open;
  std::vector<Denial> denials;
};

std::vector<Query> queriesOf(ProofStart &start, const Question &question);
/// Each goal must hold; a counterexample is replayed.
Obligation settle(const ProofContext &context, const Question &question);
void settleAll(const ProofContext &context, Questions questions, SettledRows &into);
/// The verdict that does not depend on the goals: by one of the sampled runs, or because paths are missing.
std::optional<Verdict> decidedBefore(const ProofContext &context, const Violation &violation);

} // namespace feedhold::prove
