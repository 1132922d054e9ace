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
  std::vector<Unfollowed> unfollowed;             // what was taken as anything at all
  std::optional<std::string_view> incomplete;     // why not all ways were followed
  std::vector<Contradiction> contradictions = {}; // defects of Feedhold
};

/// For every input that the contract allows; without one, for every input.  `contracts`: of the file of the program.
ProgramProof prove(const ProgramSet &programs, Callee program, const FileContracts *contracts,
                   const ProveOptions &options = {});

} // namespace feedhold::prove
