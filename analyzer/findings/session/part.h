// RunPart: a file with the answers of one shard of a run, and all that the run that joins the parts must know.
#pragma once

#include "base/support/result.h"
#include "findings/project/shards.h"
#include "findings/session/answers.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold {

struct RunPart {
  std::string tool;                 // differs from one build of the program to the next
  std::string prover;               // the solvers that a report names; empty: it does not matter
  std::vector<std::string> command; // that was run, and its options, but for those of the shard
  Shard shard;
  FileCosts costs; // of the shard's own files
  std::map<std::string, std::string> answers;
};

/// Same part, same bytes.
std::string writePart(const RunPart &part);
/// Errors: it is no part, or it is damaged.
Result<RunPart> readPart(std::string_view bytes);

/// All parts of one run in one.  Errors: they are parts of different runs, or not all are there.  One that is given
/// twice, as of a shard that was started again, is no error.
Result<RunPart> joinParts(std::vector<RunPart> parts);

} // namespace feedhold
