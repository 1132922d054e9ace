// ProveOptions: what to prove of one program, and how much work to spend.
#pragma once

#include "language/contract/contract.h"
#include "proof/explore/exploration.h"
#include "proof/obligation/obligation.h"

namespace feedhold::prove {

enum class InferGuards : std::uint8_t { No, Yes };

struct ProveOptions {
  std::vector<ObligationKind> only = {}; // empty: all
  Budget budget = {};
  std::uint64_t steps = kStepsOfProgram; // of all that is done for the program (smt/steps.h)
  InferGuards guards = InferGuards::Yes;
  Arithmetic arithmetic = Arithmetic::Exact; // in which claims have to hold
  MissingPrograms missing = MissingPrograms::DoAnything;
  /// May claims rest on loops making no more than kMostPasses?  A verdict that does says so.
  bool mayTakeFewPasses = false;
  bool takesFewPasses = false; // in this proof: set by prove() alone
  /// Those that are taken to return (MissingPrograms::Return) change nothing, in this proof: set by prove() alone.
  bool missingChangeNothing = false;
  std::vector<const FileContracts *> contractsOf = {}; // by file: of the programs that may be called; empty: none
  /// Of programs that are called and in none of the files, by number: each the only one of its FileContracts.
  std::map<std::uint32_t, const FileContracts *> missingContracts = {};
};

} // namespace feedhold::prove
