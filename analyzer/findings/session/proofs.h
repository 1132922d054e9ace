// Proofs: every program of a set of files, with its folder, and the verdicts on what it has to keep.
#pragma once

#include "findings/project/shards.h"
#include "findings/session/answers.h"
#include "findings/session/proof_cache.h"
#include "findings/session/proof_record.h"
#include "proof/prove/prove.h"

#include <memory>
#include <stop_token>
#include <vector>

namespace feedhold {

/// Whether all steps are kept that were certified on the way to the verdicts.
enum class KeepSteps : std::uint8_t { No, Yes };

struct ProofOptions {
  CheckOptions files; // which, how they are read, and on how many threads
  prove::ProveOptions prove = {
      .arithmetic = prove::Arithmetic::Doubles, .missing = MissingPrograms::Return, .mayTakeFewPasses = true};
  std::optional<ProofCache> cache = {}; // absent: everything is proved anew, with its evidence
  KeepSteps steps = KeepSteps::No;      // of what is proved anew
  enum class Which : std::uint8_t { All, WithContract } which = Which::All; // of the programs
  AnswerUse answers = {};                                                   // of proofs without their evidence
  std::stop_token stop = {}; // once it is requested, there are no files in the result
};

struct ProvedProgram {
  ProgramId program;
  prove::ProgramProof proof;
  ProofSteps steps = {};
  std::shared_ptr<const std::string> record = nullptr; // of a remembered proof: where its reasons lie
};

struct ProvedFile {
  std::unique_ptr<const Project> project; // the file itself is FileId(0)
  std::vector<ProvedProgram> programs;    // as they stand in the file

  const ProjectFile &file() const { return project->file(FileId(0)); }
};

struct ProofsResult {
  std::vector<ProvedFile> files;    // by path
  std::vector<SkippedFile> skipped; // by path
  std::vector<PathProblem> errors;  // files that could not be read, contracts with mistakes
};

ProofsResult proveAll(const ProofOptions &options, const KnownNames &known);

/// What the proofs of each file cost, in steps.
FileCosts costsOf(const ProofsResult &result);

} // namespace feedhold
