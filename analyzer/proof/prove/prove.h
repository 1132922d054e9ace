// prove: the obligations of one program and a verdict on each.
#pragma once

#include "language/contract/contract.h"
#include "proof/prove/exploration.h"
#include "proof/prove/obligation.h"

namespace feedhold::prove {

enum class InferGuards : std::uint8_t { No, Yes };

struct ProveOptions {
  std::vector<ObligationKind> only = {}; // empty: all
  Budget budget = {};
  std::uint64_t steps = kStepsOfProgram; // of all that is done for the program (smt/steps.h)
  InferGuards guards = InferGuards::Yes;
  std::vector<const FileContracts *> contractsOf = {}; // by file: of the programs that may be called; empty: none
};

/// A run did what a verdict denies.  The verdict has been withdrawn.
struct Contradiction {
  std::string id;      // of the obligation
  std::string verdict; // that was withdrawn: `proved`
  Witness run;
};

struct ProgramProof {
  std::vector<Obligation> obligations;            // by kind, then by place
  std::vector<Unfollowed> unfollowed;             // what was taken as anything at all
  std::optional<std::string_view> incomplete;     // why not all ways were followed
  std::vector<Contradiction> contradictions = {}; // defects of Feedhold
};

/// For every input that the contract allows; without one, for every input.  `contracts`: of the file of the program.
ProgramProof prove(const ProgramSet &programs, Callee program, const FileContracts *contracts,
                   const ProveOptions &options = {});

} // namespace feedhold::prove
