// ProofStart: the inputs of one program as terms, and what its contract says of its start.
#pragma once

#include "proof/context/prove_options.h"
#include "proof/decide/entails.h"
#include "proof/replay/start_inputs.h"
#include "proof/space/space_claims.h"
#include "proof/symbolic/contract_terms.h"

#include <memory>
#include <optional>
#include <vector>

namespace feedhold::prove {

/// Which program is proved, and what is said of it.
struct ProofSubject {
  const ProgramSet &programs;
  Callee program;
  const FileContracts *contracts; // of the file of the program; null: none
  const ProveOptions &options;

  const ProgramFile &file() const { return programs.file(program.file); }
  const Dialect &dialect() const { return *file().dialect; }
  const Contract *contract() const { return contracts ? contracts->of(program.program) : nullptr; }
  const std::string &textOf(ClauseId clause) const { return contracts->clauses[clause].text; }
  bool wants(ObligationKind kind) const;
  /// Null: calls of that program need not satisfy anything.
  const FileContracts *contractsOf(const Callee &callee) const;
  std::string nameOf(const Callee &callee) const;
  std::string name() const { return nameOf(program); }
  /// Numbers that the program and its contract write: where its conditions change their outcome.
  std::vector<double> constants() const;

  bool isOwn(Place place) const;
  Span spanOf(Place place) const { return file().tree->blocks[programs.node(place).block].span(); }
  /// `line 12`, or `line 12 of O9110` in another program.
  std::string lineOf(Place place) const;
  Place head() const { return {program.file, program.entry}; }
  /// Without a verdict, which is Unknown.
  Obligation obligation(ObligationKind kind, Place place, Span span, std::string claim) const;
  /// Of the program as a whole.
  Obligation obligation(ObligationKind kind, std::string claim) const {
    return obligation(kind, head(), spanOf(head()), std::move(claim));
  }
};

/// Made once.  Later questions add terms to the store and facts about them, and change nothing that is there.
class ProofStart {
public:
  /// `given`: these inputs alone, in place of all that the contract allows.
  explicit ProofStart(const ProofSubject &subject, const GivenVariables *given = nullptr);
  ProofStart(const ProofStart &) = delete;
  ProofStart &operator=(const ProofStart &) = delete;

  smt::TermStore &store() { return store_; }
  SymbolicInterpretation &interpretation() { return interpretation_; }
  ContractTerms &terms() { return *terms_; }
  const SpaceClaims &space() const { return *space_; }
  const SymbolicState &entry() const { return entry_; }
  /// Any start, within the contract or outside of it.
  const SymbolicState &anyEntry() const { return anyEntry_; }
  /// What the contract demands of the inputs.
  const std::vector<smt::TermId> &demands() const { return demands_; }
  /// Codes and place of the runs of the machine, as the contract says; no place of an axis that it leaves open.
  RunOptions runStart() const;
  std::map<Axis, smt::TermId> place() const;
  /// What neither says.
  StartInputs openStart(const Dialect &dialect) const;

  /// The radii that a model has for ranges of `@OFFSET`, by number of D.
  std::vector<std::pair<double, double>> offsetsIn(const smt::Model &model) const;

  /// All conditions of a path, and what is known of the variables in them.
  Query onPath(const std::vector<smt::TermId> &conditions, smt::TermId goal);
  /// What the contract adds to the options of an exploration, which then refer to this and to the subject.
  ExploreOptions exploreOptions(const ProofSubject &subject, ExploreOptions options = {});

private:
  using HintTerm = std::function<smt::TermId(ExpressionId, const SymbolicState &)>;
  void keepPolar(const Dialect &dialect);
  void readContract(const ProofSubject &subject);
  void leaveMappingsOpen(const ProofSubject &subject);
  OffsetOfCutter cutterOffsets(const Contract &contract);
  std::optional<PathOffset> noseOf(const Contract &contract);
  PathOffset rangeOf(const RadiusOffset &offset, smt::TermId number);
  smt::TermId registerOf(ExpressionId radius);

  smt::TermStore store_;
  SymbolicInterpretation interpretation_;
  SymbolicState anyEntry_;
  SymbolicState entry_;                  // as the contract says
  decltype(SymbolicState::codes) codes_; // as the contract says
  std::vector<smt::TermId> demands_;
  std::unique_ptr<ContractTerms> terms_;
  std::unique_ptr<SpaceClaims> space_;
  std::map<std::pair<std::uint32_t, smt::TermId>, smt::TermId> radii_; // by clause and number of D
  FactIndex facts_{store_};
};

} // namespace feedhold::prove
