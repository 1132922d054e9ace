// Where POSIX systems, and WebAssembly on any of them, keep what can be made again.
#include "surface/cli/platform.h"

#include <cstdlib>

namespace feedhold {

std::optional<std::filesystem::path> userCache() {
  const auto variable = [](const char *name) {
    const char *value = std::getenv(name);
    return std::filesystem::path(value == nullptr ? "" : value);
  };
  // The specification wants an absolute path and tells to pass over any other.
  if (const std::filesystem::path cache = variable("XDG_CACHE_HOME"); cache.is_absolute())
    return cache / "feedhold";
  if (const std::filesystem::path home = variable("HOME"); home.is_absolute())
    return home / ".cache" / "feedhold";
  return std::nullopt;
}

} // namespace feedhold
