#include "surface/cli/cache_place.h"

#include "surface/cli/platform.h"

#include <fmt/format.h>

#include <string>

namespace feedhold {

namespace fs = std::filesystem;

std::optional<ProofCache> proofCache(const std::optional<fs::path> &folder) {
  const std::optional<fs::path> place = folder ? folder : userCache();
  const std::string id = buildId();
  if (!place || id.empty())
    return std::nullopt;
  return ProofCache{*place, fmt::format("feedhold {} {}", FEEDHOLD_VERSION, id)};
}

} // namespace feedhold
