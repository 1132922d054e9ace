// Where the verdicts of earlier runs are kept, and which build of the program this is.
#pragma once

#include "findings/session/proof_cache.h"

#include <filesystem>
#include <optional>

namespace feedhold {

/// In `folder`, or else in the cache of the user: `$XDG_CACHE_HOME/feedhold`, `~/.cache/feedhold`.  Absent: there is no
/// such place, or one build of the program cannot be told from another.
std::optional<ProofCache> proofCache(const std::optional<std::filesystem::path> &folder);

} // namespace feedhold
