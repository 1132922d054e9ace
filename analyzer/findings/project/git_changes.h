// What the version control knows: which files differ from a revision.  Runs `git`.
#pragma once

#include "base/support/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace feedhold {

/// In the repositories of `paths` (files or folders): the files that differ from where the branch left `revision`,
/// those that are gone and those that git does not know yet, as absolute paths.  Errors: no git, no repository, no such
/// revision.
Result<std::vector<std::filesystem::path>> changedSince(const std::string &revision,
                                                        const std::vector<std::string> &paths);

} // namespace feedhold
