// Affected: the programs that a change may concern: those that changed and all that call them, over any number of
// calls.
#pragma once

#include "findings/project/workload.h"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace feedhold {

struct Affected {
  std::set<std::string> programs;  // as they are shown
  std::vector<PathProblem> errors; // of the files among which was searched
};

/// `changed` are absolute paths of programs, files with contracts and configurations; they may be gone.  A call whose
/// program is only known in a run may reach every program of its folder.
Affected affectedBy(const std::vector<std::filesystem::path> &changed, const CheckOptions &among,
                    const KnownNames &known);

/// The same for files that are named: searched are their folders.
Affected affectedByNamed(const std::vector<std::string> &named, const CheckOptions &options, const KnownNames &known);

} // namespace feedhold
