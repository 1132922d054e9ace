// BundleReading as JSON, for the index of a bundle and for the report.
#pragma once

#include "surface/evidence/evidence_bundle.h"
#include "surface/sink/json_parts.h"

namespace feedhold {

/// `folder`: of the document, from which files are named.
json::Json readingToJson(const BundleReading &reading, const std::filesystem::path &folder);
/// Throws an exception of the JSON library if it is not of that form.
BundleReading readingFrom(const json::Json &reading, const std::filesystem::path &folder);

} // namespace feedhold
