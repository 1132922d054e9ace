// prove: the obligations of one program and a verdict on each.
#pragma once

#include "proof/context/prove_options.h"

namespace feedhold::prove {

/// A run did what a verdict denies.  The verdict has been withdrawn.
struct Contradiction {
  std::string id;      // of the obligation
  std::string verdict; // that was withdrawn: `proved`
  Witness run;
};

struct ProgramProof {
  std::vector<Obligation> obligations;            // by kind, then by place
  std::vector<Unmodelled> unmodelled;             // what is not modelled
  std::optional<std::string> incomplete;          // why not all paths were explored
  std::vector<Contradiction> contradictions = {}; // bugs in Feedhold
};

/// For every input that the contract allows; without one, for every input.  `contracts`: of the file of the program.
ProgramProof prove(const ProgramSet &programs, Callee program, const FileContracts *contracts,
                   const ProveOptions &options = {});

} // namespace feedhold::prove
