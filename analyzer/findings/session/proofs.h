// Proofs: every program of a set of files, with its folder, and the verdicts on what it has to keep.
#pragma once

#include "findings/session/programs.h"
#include "proof/prove/prove.h"

#include <memory>
#include <vector>

namespace feedhold {

struct ProofsWish {
  CheckOptions files; // which, how they are read, and on how many threads
  prove::ProveOptions prove = {};
};

struct ProvedProgram {
  ProgramId program;
  prove::ProgramProof proof;
};

struct ProvedFile {
  std::unique_ptr<const LoadedPrograms> loaded; // the file itself is FileId(0)
  std::vector<ProvedProgram> programs;          // as they stand in the file

  const LoadedFile &file() const { return loaded->file(FileId(0)); }
};

struct ProofsResult {
  std::vector<ProvedFile> files;    // by path
  std::vector<SkippedFile> skipped; // no NC programs; by path
  std::vector<PathProblem> errors;  // files that could not be read, contracts with mistakes
};

ProofsResult proveAll(const ProofsWish &wish, const KnownNames &known);

} // namespace feedhold
