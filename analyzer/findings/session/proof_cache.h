// Proof cache: verdicts of earlier runs, each under a hash of all that it depends on.  What is not found, cannot be
// read or does not fit is proved again; what cannot be written is forgotten.
#pragma once

#include "findings/project/project.h"
#include "findings/session/shared_cache.h"
#include "proof/prove/prove.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace feedhold {

struct ProofCache {
  std::filesystem::path folder;                  // is made when it is not there
  std::string tool;                              // differs from one build of the program to the next
  std::shared_ptr<SharedCache> shared = nullptr; // asked for what is not in the folder; null: none
};

/// Who proves: the build of the program and its solver.
std::string proverOf(const ProofCache &cache);

/// A hash of the program, all files that were loaded with it, their contracts, the dialect with its settings, the
/// options and the prover.
std::string proofKey(std::string_view prover, const Project &programs, ProgramId program,
                     const prove::ProveOptions &options);

struct RememberedProof {
  prove::ProgramProof proof;
  std::shared_ptr<const std::string> record; // where its reasons lie
};
std::optional<RememberedProof> recall(const ProofCache &cache, const std::string &key, const ProgramSet &programs);

/// Without the evidence.
void remember(const ProofCache &cache, const std::string &key, const prove::ProgramProof &proof);

} // namespace feedhold
