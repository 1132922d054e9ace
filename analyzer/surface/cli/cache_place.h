// Where the verdicts of earlier runs are kept, and which build of the program this is.
#pragma once

#include "base/support/result.h"
#include "findings/session/proof_cache.h"

#include <filesystem>
#include <optional>

namespace feedhold {

/// In `folder`, or else in the cache of the user: `$XDG_CACHE_HOME/feedhold`, `~/.cache/feedhold`; and shared at `url`,
/// or else at `$FEEDHOLD_CACHE_URL`, with the key in `$FEEDHOLD_CACHE_KEY`.  Absent: there is no such place, or one
/// build of the program cannot be told from another.  Errors: the address is none, or there is no key.
Result<std::optional<ProofCache>> proofCache(const std::optional<std::filesystem::path> &folder,
                                             const std::string &url);

} // namespace feedhold
