// Walks folders in the order of names, so that the same tree gives the same list on every machine.
#include "findings/project/discovery.h"

#include "base/source/disk_path.h"
#include "base/source/path_text.h"
#include "base/support/system_words.h"
#include "base/support/text.h"
#include "findings/project/shards.h"
#include "findings/project/sidecars.h"
#include "language/dialect/text_signals.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace feedhold {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 11> kProgramExtensions = {"nc",  "cnc", "tap", "ngc", "eia", "min",
                                                                 "mpf", "spf", "prg", "ncd", "mac"};

template <std::size_t Count> bool isOneOf(std::string_view word, const std::array<std::string_view, Count> &words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// `O1234`: how controls name the files of their memory.
bool isProgramNumberName(std::string_view stem) {
  return stem.size() >= 2 && toUpper(stem.front()) == 'O' && std::all_of(stem.begin() + 1, stem.end(), isDigit);
}

/// `./part.nc` -> `part.nc`: what a walk of the current folder puts before every name.
fs::path plainPath(const fs::path &path) {
  const std::string text = pathText(path);
  return text.starts_with("./") && text.size() > 2 ? fs::path(text.substr(2)) : path;
}

std::string shownPath(const fs::path &path) { return pathText(plainPath(path)); }

std::string relativeTo(const fs::path &folder, const fs::path &path) {
  return pathText(normalPath(absolutePath(path)).lexically_relative(folder));
}

bool matchesAny(const std::vector<std::string> &patterns, const Config &config, const fs::path &path) {
  if (patterns.empty())
    return false;
  const std::string relative = relativeTo(config.folder, path);
  return std::any_of(patterns.begin(), patterns.end(),
                     [&](const std::string &pattern) { return patternMatches(pattern, relative); });
}

class Walker {
public:
  explicit Walker(ConfigFinder &configs) : configs_(configs) {}

  void add(const std::string &named) {
    const fs::path path(named);
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::is_directory(status))
      addFolder(path);
    else if (fs::exists(status) && isSidecarName(path))
      result_.problems.push_back({shownPath(path), "is a contract file; name its program instead"});
    else if (fs::exists(status))
      take(path, FoundBy::Name, configs_.forFolder(folderOf(path)));
    else
      result_.problems.push_back({shownPath(path), reasonFor(error)});
  }

  void addFolderAlone(const fs::path &folder) {
    depth_ = Depth::FolderAlone;
    walk(folder);
  }

  Discovery finish() {
    std::stable_sort(result_.files.begin(), result_.files.end(),
                     [](const FoundFile &a, const FoundFile &b) { return a.shown < b.shown; });
    std::stable_sort(result_.others.begin(), result_.others.end(),
                     [](const SkippedFile &a, const SkippedFile &b) { return a.path < b.path; });
    return std::move(result_);
  }

private:
  enum class Depth : std::uint8_t { FolderAlone, AllBelow };

  static fs::path folderOf(const fs::path &file) {
    const fs::path parent = file.parent_path();
    return parent.empty() ? fs::path(".") : parent;
  }

  static std::string reasonFor(const std::error_code &error) {
    if (!error || error == std::errc::no_such_file_or_directory)
      return "no such file or folder; check the spelling and the current folder";
    return fmt::format("cannot be read: {}", inWords(error));
  }

  void addFolder(const fs::path &folder) {
    const std::size_t before = result_.files.size() + passedOver_;
    const std::size_t problemsBefore = result_.problems.size() + configs_.problems().size();
    walk(folder);
    if (result_.files.size() + passedOver_ == before &&
        result_.problems.size() + configs_.problems().size() == problemsBefore)
      result_.problems.push_back({shownPath(folder), "no program in this folder; name the file itself, or add its "
                                                     "pattern to `include` in feedhold.toml"});
  }

  void walk(const fs::path &folder) {
    std::error_code error;
    std::vector<fs::directory_entry> entries;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
      entries.push_back(*at);
    if (error) {
      result_.problems.push_back({shownPath(folder), fmt::format("cannot be listed: {}", inWords(error))});
      return;
    }
    std::sort(entries.begin(), entries.end());
    const Config *config = configs_.forFolder(folder);
    for (const fs::directory_entry &entry : entries)
      visit(entry, config);
  }

  void visit(const fs::directory_entry &entry, const Config *config) {
    const fs::path &path = entry.path();
    std::error_code ignored; // what cannot be asked for its kind is no regular file for us
    const std::string name = pathText(path.filename());
    const bool isFolder = entry.is_directory(ignored);
    if ((isFolder ? name.starts_with('.') : isHiddenFileName(name)) ||
        (config != nullptr && matchesAny(config->exclude, *config, path)))
      return;
    if (isFolder) {
      if (!entry.is_symlink(ignored) && depth_ == Depth::AllBelow)
        walk(path);
      return;
    }
    if (!entry.is_regular_file(ignored) || name == kConfigFileName || isSidecarName(path) ||
        path.extension() == kPartEnd)
      return;
    if (const std::optional<FoundBy> kind = kindOf(path, name, config))
      take(path, *kind, config);
    else
      result_.others.push_back(
          {shownPath(path), fmt::format("a `{}` file", pathText(path.extension())), SkipKind::NoProgram});
  }

  static std::optional<FoundBy> kindOf(const fs::path &path, std::string_view name, const Config *config) {
    if (config != nullptr && matchesAny(config->include, *config, path))
      return FoundBy::Extension;
    return kindOfFileName(name);
  }

  void take(const fs::path &path, FoundBy foundBy, const Config *config) {
    const bool isNew = seen_.insert(diskPath(path)).second;
    if (!isNew || config == nullptr) {
      ++passedOver_;
      return;
    }
    result_.files.push_back({plainPath(path), shownPath(path), foundBy, config});
  }

  ConfigFinder &configs_;
  Discovery result_;
  Depth depth_ = Depth::AllBelow;
  std::set<fs::path> seen_;
  std::size_t passedOver_ = 0; // programs that were there and are not in the list
};

} // namespace

bool isHiddenFileName(std::string_view name) {
  if (!name.starts_with('.'))
    return false;
  const bool isBeside = name.size() < 2 || std::string_view("#~._").find(name[1]) != std::string_view::npos;
  return isBeside || name.rfind('.') == 0 || kindOfFileName(name) != FoundBy::Extension;
}

std::optional<FoundBy> kindOfFileName(std::string_view name) {
  const std::size_t point = name.rfind('.');
  const std::string extension = point == std::string_view::npos ? "" : toLower(name.substr(point + 1));
  if (isOneOf(extension, kProgramExtensions) || (extension.empty() && isProgramNumberName(name)))
    return FoundBy::Extension;
  return namesOtherFormat(name) ? std::nullopt : std::optional(FoundBy::Content);
}

bool isNamedByChance(const SkippedFile &skipped, const std::vector<std::string> &named) {
  return kindOfFileName(fs::path(skipped.path).filename().string()) == FoundBy::Content &&
         std::find(named.begin(), named.end(), skipped.path) != named.end();
}

std::vector<FoundFile> discoverFolder(const fs::path &folder, ConfigFinder &configs) {
  Walker walker(configs);
  walker.addFolderAlone(folder);
  return walker.finish().files;
}

Discovery discover(const std::vector<std::string> &paths, ConfigFinder &configs) {
  // Files before folders, so that a file which is named and also lies in a named folder counts as named.
  std::vector<std::string> ordered = paths;
  std::stable_partition(ordered.begin(), ordered.end(), [](const std::string &path) {
    std::error_code ignored; // what cannot be asked is reported when it is added
    return !fs::is_directory(path, ignored);
  });
  Walker walker(configs);
  for (const std::string &path : ordered)
    walker.add(path);
  return walker.finish();
}

} // namespace feedhold
