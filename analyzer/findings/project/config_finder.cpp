// Searches folders upwards and remembers the answer for each.
#include "findings/project/config_finder.h"

#include "base/source/path_text.h"
#include "base/source/source_file.h"

#include <fmt/format.h>

namespace feedhold {

namespace fs = std::filesystem;

const Config *ConfigFinder::forFolder(const fs::path &folder) {
  switch (options_.source) {
  case ConfigSource::Nearest: return search(normalPath(absolutePath(folder))).get();
  case ConfigSource::Named: return search({}).get();
  case ConfigSource::None: break;
  }
  static const Config kDefaults{};
  return &kDefaults;
}

ConfigFinder::Found ConfigFinder::search(const fs::path &folder) {
  if (const auto known = byFolder_.find(folder); known != byFolder_.end())
    return known->second;
  Found found;
  std::error_code ignored; // a folder that cannot be looked into has no configuration for us
  const fs::path here = options_.source == ConfigSource::Named ? options_.file : folder / kConfigFileName;
  if (options_.source == ConfigSource::Named || fs::is_regular_file(here, ignored))
    found = load(here);
  else if (folder == folder.root_path() || folder.empty())
    found = std::make_shared<const Config>();
  else
    found = search(folder.parent_path());
  return byFolder_[folder] = found;
}

ConfigFinder::Found ConfigFinder::load(const fs::path &file) {
  Result<SourceFile> source = SourceFile::open(file);
  if (!source) {
    problems_.push_back({pathText(file), source.error().message});
    return nullptr;
  }
  const fs::path folder = normalPath(absolutePath(file)).parent_path();
  ConfigText text = readConfig(source.value().text(), folder, known_);
  for (const ConfigError &error : text.errors)
    problems_.push_back({fmt::format("{}:{}:{}", pathText(file), error.line, error.column), error.message});
  if (!text.errors.empty())
    return nullptr;
  return std::make_shared<const Config>(std::move(text.config));
}

} // namespace feedhold
