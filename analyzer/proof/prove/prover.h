// Prover: what the proofs of one program share.
#pragma once

#include "meaning/cfg/wto.h"
#include "proof/prove/contract_terms.h"
#include "proof/prove/entails.h"
#include "proof/prove/guard_candidates.h"
#include "proof/prove/prove.h"
#include "proof/prove/space_claims.h"
#include "proof/prove/termination.h"
#include "proof/prove/witness.h"

#include <memory>

namespace feedhold::prove {

class Prover {
public:
  Prover(const ProgramSet &programs, Callee program, const FileContracts *contracts, const ProveOptions &options);
  ProgramProof run();

private:
  /// For these inputs alone: what can be told of them without a proof.
  Prover(const ProgramSet &programs, Callee program, const FileContracts *contracts, const ProveOptions &options,
         const GivenVariables &given);
  bool breaksExactly(const GivenVariables &given, ObligationKind kind, const std::string &claim, Place place) const;
  std::vector<Obligation> brokenPromises(const GivenVariables &given) const;
  Violation brokenPromise(const Obligation &obligation) const;
  void explore();
  void leaveMappingsOpen(const decltype(SymbolicState::codes) &anyCodes);
  void settleAll();
  void withdraw(std::string_view reason);

  // ---- places where a run may stop (prover_stops.cpp) ----
  void stops();
  void unmetAlarms();
  smt::TermId isOneOf(const SymbolicValue &value, const std::vector<std::uint32_t> &numbers);
  // ---- other obligations of the program's own text (prover.cpp) ----
  void loops();
  void programEnds();
  // ---- where all loops have few passes (prover_passes.cpp) ----
  void followPasses();
  void takeUnmet(Obligation obligation);
  void endsByPasses(Obligation &obligation) const;
  // ---- whether rounding would break a proof (prover_rounding.cpp) ----
  void checkRounding();
  bool isStillProved(const Check &check);
  // ---- promises of the contract (prover_contract.cpp) ----
  void promises();
  void callsMeetContracts();
  void callsWithoutModalCalls();
  const FileContracts *contractsOf(const Callee &callee) const;
  std::string programName(const Callee &callee) const;
  void satisfiable();
  void ensures();
  void modalPreserved(ClauseId clause);
  void assigns();
  void alarmPromises();
  void guarded();
  void requireEnds(Obligation &obligation);

  // ---- claims about space (prover_space.cpp) ----
  void spaces();
  bool mayHaveSign(smt::TermId id) const;
  void learnSigns();
  void space(const SpaceRule &rule, Place own, const std::vector<const MoveInstance *> &moves);
  void decideSpace(Obligation &obligation, const SpaceRule &rule, const std::vector<const MoveInstance *> &moves,
                   const Violation &violation);
  bool isProvedFor(Obligation &obligation, const std::vector<smt::TermId> &conditions, const SpaceQuestion &question,
                   const Budget &budget, std::optional<smt::Model> *model = nullptr);
  const Outcome &answered(const Query &query, const Budget &budget);
  bool isGivenAtStart(Axis axis) const;
  std::optional<std::string> notFollowedAt(Place place) const;
  std::string whyOpen(const std::vector<smt::TermId> &conditions, const SpaceQuestion &question);
  std::optional<GougeAt> gougeIn(const SpaceRule &rule, Place own, const RunResult &run,
                                 const GivenVariables &given) const;
  Violation gouges(const SpaceRule &rule, Place own) const;
  void findMargin(Obligation &obligation, const SpaceRule &rule, const std::vector<const MoveInstance *> &moves);
  bool keepsAway(Obligation trial, const SpaceRule &rule, const std::vector<const MoveInstance *> &moves);
  void noteRounding(Obligation &obligation, const SpaceRule &rule) const;
  void limits();
  bool breaksLimit(const WordLimit &limit, const RecordedMove &recorded, const GivenVariables &given) const;

  // ---- conditions with which a claim is proved that is not proved without (prover_guard.cpp) ----
  struct OpenClaim {
    Obligation claim;
    std::vector<Query> queries;
  };
  void guards();
  GuardSubject subjectOf(const Obligation &claim) const;
  std::optional<std::vector<GuardAtom>> atomsFor(const Obligation &claim, const GuardSubject &subject, int &proofsLeft);
  Guard guardOf(const Obligation &claim, const std::vector<GuardAtom> &atoms) const;
  smt::TermId conditionOf(const std::vector<GuardAtom> &atoms);
  bool isContradiction(smt::TermId condition);
  bool isPossible(smt::TermId condition);
  Obligation provedWith(const Obligation &claim, const GuardSubject &subject, smt::TermId condition);
  void exploredWith(Obligation &claim, smt::TermId condition);
  bool isOutOfFocus(const Obligation &obligation) const;

  Obligation &add(ObligationKind kind, Place place, Span span, std::string claim);
  std::string idOf(ObligationKind kind, Place place, Span span) const;
  bool wanted(ObligationKind kind) const;
  /// Each query must hold; a counterexample is replayed.  Without queries the place is not reached.
  void settle(Obligation &obligation, const std::vector<Query> &queries, const Violation &violation);
  void decideSingleRun(Obligation &obligation, const std::vector<Query> &queries) const;
  ExploreOptions exploreOptions() const;
  using HintTerm = std::function<smt::TermId(ExpressionId, const SymbolicState &)>;
  LoopHints hintsOf(const std::vector<LoopHint> &hints, const HintTerm &termOf) const;
  bool staysIn(const LoopInstance &loop, const RunResult &run) const;
  bool isMeantToGoOn(const Wto &wto, NodeId head) const;
  void start(WitnessSearch &witnesses) const;
  static void dropProof(Obligation &obligation);
  void decide(Obligation &obligation, const std::vector<Query> &queries, const Violation &violation);
  bool isDecided(Obligation &obligation, const Violation &violation);
  void takeProof(Obligation &obligation, Outcome outcome);
  Termination endOf(const LoopInstance &loop);
  bool goesOn(const LoopInstance &loop, const GivenVariables &given);
  std::optional<Witness> endless(const LoopInstance &loop);
  std::optional<Witness> endlessFromStart(const LoopInstance &loop);
  void settleLoop(Obligation &obligation, const std::vector<const LoopInstance *> &instances,
                  const Violation &violation);
  void explainEnd(Obligation &obligation, const std::vector<const LoopInstance *> &instances);
  /// All conditions of a path, and what is known of the variables in them.
  Query onPath(const std::vector<smt::TermId> &conditions, smt::TermId goal);

  bool isOwn(Place place) const;
  const ProgramFile &file() const { return programs_.file(program_.file); }
  const Contract *contract() const;
  std::vector<double> constants() const;

  const ProgramSet &programs_;
  Callee program_;
  const FileContracts *contracts_;
  const ProveOptions &options_;
  bool isSingleRun_ = false; // one input is followed, and nothing is proved
  smt::TermStore store_;
  SymbolicReading reading_;
  SymbolicState entry_;
  decltype(SymbolicState::codes) startCodes_; // as the contract says
  std::vector<smt::TermId> demands_;
  std::unique_ptr<ContractTerms> terms_;
  std::unique_ptr<SpaceClaims> space_;
  Exploration found_;
  std::unique_ptr<WitnessSearch> witnesses_;
  std::optional<Outcome> anyCall_; // whether the contract allows no call at all; the counterexample is one
  std::vector<std::pair<const LoopInstance *, Termination>> ends_;
  FactIndex facts_{store_};
  Budget budget_ = options_.budget;
  const Obligation *focus_ = nullptr; // all others are passed over
  std::vector<OpenClaim> open_;       // that were not proved
  std::vector<smt::Model> sampleInputs_;
  std::vector<smt::TermId> signs_; // facts about the inputs that the contract allows
  std::map<std::pair<std::vector<smt::TermId>, std::uint64_t>, Outcome>
      answers_;                                                        // by assumptions with the goal, budget
  mutable std::map<InputsKey, std::vector<Obligation>> brokenExactly_; // by inputs
  std::uint64_t guardWork_ = 2'000'000;                                // of explorations under conditions
  std::optional<Wto> wto_;                                             // of the program, for guards
  ProgramProof proof_;
};

} // namespace feedhold::prove
