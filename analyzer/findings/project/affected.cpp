#include "findings/project/affected.h"

#include "base/source/path_text.h"
#include "findings/project/discovery.h"
#include "findings/project/project.h"
#include "findings/project/remaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

namespace feedhold {

namespace fs = std::filesystem;

namespace {

fs::path absoluteOf(const fs::path &path) { return normalPath(absolutePath(path)); }

bool isBelow(const fs::path &path, const fs::path &folder) {
  const fs::path relative = path.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

bool isConfigName(const fs::path &path) { return path.filename() == kConfigFileName; }

/// Files of a run with their calls.
class Callers {
public:
  explicit Callers(const Project &project) : project_(project), callers_(project.files.size()) {
    for (std::size_t i = 0; i < project.files.size(); ++i)
      for (const Call &call : model(i).calls)
        if (const auto callee = project.callGraph.callee(FileId(i), call))
          callers_[callee->file.index()].push_back(i);
        else if (call.callee.empty())
          openCallers_[folderOf(i)].push_back(i);
        else
          missing_.insert(i);
  }

  fs::path folderOf(std::size_t file) const { return absoluteOf(project_.files[file]->path).parent_path(); }
  const ProgramModel &model(std::size_t file) const { return project_.files[file]->model; }
  bool callsSomethingMissing(std::size_t item) const { return missing_.contains(item); }

  /// The items and all that call them.
  std::set<std::size_t> closed(const std::set<std::size_t> &from) const {
    std::set<std::size_t> reached = from;
    std::vector<std::size_t> open(from.begin(), from.end());
    const auto reach = [&](std::size_t item) {
      if (reached.insert(item).second)
        open.push_back(item);
    };
    while (!open.empty()) {
      const std::size_t item = open.back();
      open.pop_back();
      for (const std::size_t caller : callers_[item])
        reach(caller);
      if (const auto found = openCallers_.find(folderOf(item)); found != openCallers_.end())
        for (const std::size_t caller : found->second)
          reach(caller);
    }
    return reached;
  }

private:
  const Project &project_;
  std::vector<std::vector<std::size_t>> callers_;            // by item
  std::map<fs::path, std::vector<std::size_t>> openCallers_; // by folder: which program they call is open
  std::set<std::size_t> missing_;
};

/// What the changed paths mean for the programs beside them.
class Touch {
public:
  Touch(const std::vector<fs::path> &changed, const ConfigOptions &config) : changed_(changed.begin(), changed.end()) {
    std::error_code ignored;
    for (const fs::path &path : changed_) {
      if (config.source == ConfigSource::Nearest && isConfigName(path))
        configFolders_.push_back(path.parent_path());
      if (config.source != ConfigSource::None && isRemapFileName(path))
        remapFolders_.push_back(path.parent_path());
      if (kindOfFileName(pathText(path.filename())) && !fs::exists(path, ignored))
        gone_.insert(path.parent_path());
    }
    everything_ = config.source == ConfigSource::Named && changed_.contains(absoluteOf(config.file));
  }

  bool touches(const WorkItem &item, const Callers &callers, std::size_t index) const {
    const fs::path path = absoluteOf(item.path);
    if (everything_ || changed_.contains(path))
      return true;
    const auto isBelowOneOf = [&](const std::vector<fs::path> &folders) {
      return std::any_of(folders.begin(), folders.end(), [&](const fs::path &folder) { return isBelow(path, folder); });
    };
    const bool isConfigured =
        isBelowOneOf(configFolders_) || (item.profile->dialect.grammar.oWords && isBelowOneOf(remapFolders_));
    // A program that is gone was perhaps what a call without a goal has meant.
    if (isConfigured || (gone_.contains(path.parent_path()) && callers.callsSomethingMissing(index)))
      return true;
    std::vector<fs::path> sidecars = sidecarNames(path, callers.model(index));
    std::ranges::move(sidecarNamesOfCalled(path, callers.model(index)), std::back_inserter(sidecars));
    return std::any_of(sidecars.begin(), sidecars.end(),
                       [&](const fs::path &sidecar) { return changed_.contains(sidecar); });
  }

private:
  std::set<fs::path> changed_;
  std::vector<fs::path> configFolders_, remapFolders_;
  std::set<fs::path> gone_; // folders that have lost a program
  bool everything_ = false;
};

} // namespace

Affected affectedBy(const std::vector<fs::path> &changed, const CheckOptions &among, const KnownNames &known) {
  const Workload workload = loadWorkload(among, known);
  const Project project =
      loadProject(workload.items, {.graphs = LoadGraphs::No, .jobs = among.jobs, .open = among.open});
  const Callers callers(project);
  const Touch touch(changed, among.config);
  std::set<std::size_t> touched;
  for (std::size_t i = 0; i < workload.items.size(); ++i)
    if (touch.touches(workload.items[i], callers, i))
      touched.insert(i);
  Affected affected{{}, workload.errors};
  for (const std::size_t item : callers.closed(touched))
    affected.programs.insert(workload.items[item].shown);
  return affected;
}

Affected affectedByNamed(const std::vector<std::string> &named, const CheckOptions &options, const KnownNames &known) {
  CheckOptions among = options;
  among.paths.clear();
  std::vector<fs::path> changed;
  std::set<std::string> folders;
  std::error_code ignored;
  for (const std::string &path : named) {
    const fs::path folder = fs::path(path).parent_path();
    const bool isFolder = fs::is_directory(path, ignored);
    if (!isFolder)
      changed.push_back(absoluteOf(path));
    // A text file that is named by chance counts as the walk through its folder sees it.
    const bool isByChance =
        fs::exists(path, ignored) && kindOfFileName(pathText(fs::path(path).filename())) == FoundBy::Content;
    if (isFolder || (!isSidecarName(path) && !isConfigName(path) && !isRemapFileName(path) && !isByChance))
      among.paths.push_back(path);
    if (!isFolder)
      folders.insert(folder.empty() ? "." : pathText(folder));
  }
  among.paths.insert(among.paths.end(), folders.begin(), folders.end());
  Affected affected = affectedBy(changed, among, known);
  // That there is no program beside a text file that was named is no mistake.
  std::erase_if(affected.errors, [&](const PathProblem &problem) {
    return folders.contains(problem.path) && fs::directory_iterator(problem.path, ignored) != fs::directory_iterator();
  });
  return affected;
}

} // namespace feedhold
