#include "surface/cli/cache_place.h"

#include "surface/cli/platform.h"

#include <fmt/format.h>

#include <cstdlib>
#include <string>

namespace feedhold {

namespace fs = std::filesystem;

namespace {

std::string variableOf(const char *name) {
  const char *value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// Null: none is asked for.
Result<std::shared_ptr<SharedCache>> sharedCache(const std::string &url) {
  std::string place = url.empty() ? variableOf("FEEDHOLD_CACHE_URL") : url;
  if (place.empty())
    return std::shared_ptr<SharedCache>();
  if (!place.starts_with("http://") && !place.starts_with("https://"))
    return Error{fmt::format("the shared cache `{}` is no address that begins with http:// or https://", place)};
  const std::size_t server = place.find("//") + 2;
  if (place.substr(server, place.find('/', server) - server).find('@') != std::string::npos)
    return Error{"the address of the shared cache holds a name or a password, which others would see; put them into "
                 "~/.netrc"};
  std::string key = variableOf("FEEDHOLD_CACHE_KEY");
  if (key.empty())
    return Error{"a shared cache needs the environment variable FEEDHOLD_CACHE_KEY: a secret of your own that all who "
                 "share it set alike; only verdicts that are signed with it are believed"};
  while (place.ends_with('/'))
    place.pop_back();
  return std::make_shared<SharedCache>(std::move(place), std::move(key));
}

} // namespace

Result<std::optional<ProofCache>> proofCache(const std::optional<fs::path> &folder, const std::string &url) {
  Result<std::shared_ptr<SharedCache>> shared = sharedCache(url);
  if (!shared)
    return shared.error();
  const std::optional<fs::path> place = folder ? folder : userCache();
  const std::string id = buildId();
  if (!place || id.empty())
    return std::optional<ProofCache>();
  return std::optional(ProofCache{*place, fmt::format("feedhold {} {}", FEEDHOLD_VERSION, id), shared.take()});
}

} // namespace feedhold
