// What all SARIF 2.1.0 outputs have in common.  Internal to sink/.
#pragma once

#include "base/diag/diagnostic.h"
#include "base/source/source_file.h"
#include "findings/session/result.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold::sarif {

using Json = nlohmann::ordered_json;

/// A path below the root is relative to it, any other is absolute.
Json artifactLocation(const std::string &path, const std::filesystem::path &root);
/// `path` is the one that is shown.
Json physicalLocation(const std::string &path, const SourceFile &source, Span span, const std::filesystem::path &root);
Json regionOf(const SourceFile &source, Span span);

Json fixToJson(const FixIt &fix, const std::string &path, const SourceFile &source, const std::filesystem::path &root);

struct Invocation {
  const std::vector<PathProblem> &errors;
  const std::vector<SkippedFile> &skipped;
  int exitCode;
};
/// The whole text.
struct Document {
  Json driver;
  Json artifacts; // null: none are listed
  Json results;
};
std::string documentText(Document document, const Invocation &invocation, const std::filesystem::path &root);

} // namespace feedhold::sarif
