// Bundle folders: bundles of proofs on disk.
#pragma once

#include "surface/evidence/evidence_bundle.h"

#include <filesystem>

namespace feedhold {

/// What a proof must be told for a bundle: all steps, no search for guards, which are no part of one, and exact
/// arithmetic, which the bundle says.  Nothing is assumed of missing programs.
void keepEvidence(ProofOptions &options);

/// A folder is only taken when it is new, empty, or holds what it will hold again, which has a file `mark`.  Absent: it
/// can be taken.
std::optional<Error> whyNoBundleFits(const std::filesystem::path &folder, std::string_view mark);

/// Puts the whole bundle in place of what was there: a reader sees the old one or the new one.  Absent: it worked.
std::optional<Error> writeBundle(const std::filesystem::path &folder, const Bundle &bundle);

/// All files below the folder.
Result<Bundle> readBundle(const std::filesystem::path &folder);

} // namespace feedhold
