// Replay: what runs break of a contract, seen from the runs alone; nothing here is shared with how claims are proved.
#pragma once

#include "proof/contract_run.h"
#include "proof/geometry/gouge.h"

#include <optional>
#include <string>
#include <vector>

namespace feedhold::mutation {

/// A call: arguments, and where the tool stands.
struct Start {
  GivenVariables given;
  std::array<double, kAxisCount> place{};
  enum class Contract : std::uint8_t { Allows, Forbids } contract = Contract::Allows;
};

/// One claim that a run broke.
struct Break {
  prove::ObligationKind kind;
  Place place;       // of the claim
  std::string name;  // the region, or the clause
  Span span;         // of alarms: where it came from
  std::string what;  // in shop words
  std::size_t start; // the number of the call

  bool isOfSameClaim(const Break &other) const {
    return kind == other.kind && place == other.place && name == other.name && span == other.span;
  }
};

/// The first program of the lines, with what it calls.
class ReplayedProgram {
public:
  ReplayedProgram(std::string_view dialect, const soundness::ProgramLines &lines);

  const soundness::LoadedSample &loaded() const { return loaded_; }
  const FileContracts &contracts() const { return contracts_; }
  Callee entry() const { return loaded_.main(); }
  const Contract *contract() const { return contracts_.of(entry().program); }
  std::string textOf(const Start &start) const;

  /// Calls that the contract allows; where it says `@GUARDED`, also some that it does not.
  std::vector<Start> starts(soundness::Random &random, int count) const;
  /// Each claim once, with the first call that breaks it.
  std::vector<Break> breaks(const std::vector<Start> &starts) const;
  /// What most calls close by break: nothing that only comes of how doubles round.
  std::vector<Break> breaksAround(const Start &start) const;
  /// Words are taken as they are written, as proofs take them.
  RunResult run(const Start &start) const;

private:
  struct Region;
  struct Run;
  soundness::EntryValues entryOf(const Start &start) const;
  RunOptions optionsOf(const Start &start) const;
  std::optional<Start> allowedStart(soundness::Random &random) const;
  bool startsInKeepOut(const Start &start) const;
  std::optional<Start> forbiddenStart(soundness::Random &random) const;
  void addPromises(std::vector<Break> &breaks, const Run &run) const;
  void addStop(std::vector<Break> &breaks, const Run &run) const;
  void addGouges(std::vector<Break> &breaks, const Run &run) const;
  void addGougesOf(std::vector<Break> &breaks, const Run &run, const geometry::PlainSpace &space,
                   const Region &region) const;
  /// By more than what doubles round.
  bool clearlyBreaks(ExpressionId condition, const soundness::EntryValues &entry, const RunResult &result) const;

  soundness::LoadedSample loaded_;
  FileContracts contracts_;
  proof_tests::ContractOnRun promises_;
};

} // namespace feedhold::mutation
