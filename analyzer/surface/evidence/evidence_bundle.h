// Proof bundles: the evidence of proofs as files, so that anybody can follow it later.  `index.json` tells the sources,
// the verdicts and which files belong to which; its shape is docs/schemas/bundle.schema.json.
#pragma once

#include "surface/sink/prove_sink.h"

#include <map>

namespace feedhold {

inline constexpr std::string_view kBundleIndex = "index.json";

/// How programs were read and what of them was proved: all that a proof of the same must be told.
struct BundleReading {
  ControlOptions control = {};
  bool isolated = false;
  std::optional<std::filesystem::path> config = std::nullopt; // that was named
  std::vector<prove::ObligationKind> only = {};
};

/// Options of the command line that make another command read programs in the same way, each behind a blank.
std::string readingOptions(const BundleReading &reading);

/// File names, `/` as separator, and their texts.
using Bundle = std::map<std::string, std::string>;

/// How a file is named in a folder that will hold a bundle; absolute where no way leads from there, and empty
/// for a text without a file.
std::string pathFrom(const std::filesystem::path &folder, const std::filesystem::path &path);

/// `folder`: where the bundle will lie; sources are named from there.  Same proofs, same bytes.
Bundle makeBundle(const ProofsResult &result, const BundleReading &reading, std::string_view version,
                  const std::filesystem::path &folder);

/// What the index of a bundle says of how it was made.
struct BundleOrigin {
  std::string version; // of the program
  std::vector<std::filesystem::path> paths;
  BundleReading reading;
};
Result<BundleOrigin> originOf(const Bundle &bundle, const std::filesystem::path &folder);

/// How a bundle differs from what proving the same now gives; a line for each difference, changed sources first.
std::vector<std::string> differences(const Bundle &stored, const Bundle &now);

} // namespace feedhold
