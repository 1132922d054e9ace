// ConfigFinder: which `feedhold.toml` speaks for a file: the nearest one upwards from it, or the one that was named.
#pragma once

#include "findings/project/config.h"
#include "findings/project/outcome.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace feedhold {

/// Where the configuration of a run comes from.
enum class ConfigSource { Nearest, Named, None };

struct ConfigOptions {
  ConfigSource source = ConfigSource::Nearest;
  std::filesystem::path file = {}; // of Named
};

class ConfigFinder {
public:
  ConfigFinder(ConfigOptions options, KnownNames known) : options_(std::move(options)), known_(known) {}

  /// Null when the nearest configuration has errors; see problems().
  const Config *forFolder(const std::filesystem::path &folder);
  /// Configurations that cannot be used, in the order in which they were met; the path says line and column.
  const std::vector<PathProblem> &problems() const { return problems_; }

private:
  using Found = std::shared_ptr<const Config>;
  Found search(const std::filesystem::path &folder);
  Found load(const std::filesystem::path &file);

  ConfigOptions options_;
  KnownNames known_;
  std::map<std::filesystem::path, Found> byFolder_;
  std::vector<PathProblem> problems_;
};

} // namespace feedhold
