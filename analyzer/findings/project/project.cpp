#include "findings/project/project.h"

#include "base/source/path_text.h"
#include "base/support/parallel.h"
#include "base/support/text.h"
#include "findings/project/content.h"
#include "findings/project/discovery.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold {

namespace fs = std::filesystem;

namespace {

/// The files of a folder that are programs by their names and their looks, by name.
Folder programsIn(const fs::path &folder, const std::shared_ptr<const OpenTexts> &open, const KnownNames &known) {
  std::vector<fs::path> names;
  std::error_code error; // a folder that cannot be listed has no other programs for us
  for (fs::directory_iterator at(folder.empty() ? fs::path(".") : folder, error), end; !error && at != end;
       at.increment(error)) {
    std::error_code ignored;
    const std::string name = pathText(at->path().filename());
    if (!isHiddenFileName(name) && kindOfFileName(name) && at->is_regular_file(ignored))
      names.push_back(folder / name);
  }
  std::sort(names.begin(), names.end());
  Folder programs;
  for (const fs::path &name : names) {
    Result<SourceFile> source = openSource(name, open);
    if (!source || whyNotText(source.value().text()))
      continue;
    const LanguageGuess guess = guessLanguage(source.value().text(), pathText(name), known.dialects);
    const bool isKnownName = kindOfFileName(pathText(name.filename())) == FoundBy::Extension;
    if (guess.looksLikeProgram && (isKnownName || guess.hasCodes))
      programs.emplace_back(name, source.take());
  }
  return programs;
}

Error whyNothing(const Workload &workload, const std::string &path) {
  if (!workload.errors.empty())
    return {fmt::format("{}: {}", workload.errors.front().path, workload.errors.front().message)};
  const std::string reason = workload.skipped.empty() ? "no program" : workload.skipped.front().reason;
  return {fmt::format("{}: {}", path, reason)};
}

/// In one spelling, however the paths were named.
std::string folderNameOf(const ProjectFile &file) {
  return file.path.empty() ? "" : pathText(normalPath(absolutePath(file.path)).parent_path());
}

void connect(Project &project, LoadGraphs graphs, unsigned jobs) {
  std::vector<ModelledFile> models;
  for (std::size_t i = 0; i < project.files.size(); ++i) {
    const ProjectFile &file = *project.files[i];
    models.push_back({FileId(i), folderNameOf(file), pathText(file.path.stem()), &file.model});
  }
  project.callGraph = CallGraph(std::move(models));
  if (graphs == LoadGraphs::No)
    return;
  std::vector<ProgramFile> files;
  for (std::size_t i = 0; i < project.files.size(); ++i) {
    const ProjectFile &file = *project.files[i];
    files.push_back({FileId(i), &file.source, &file.tree, &file.model, file.dialect.get()});
  }
  project.set.emplace(std::move(files), project.callGraph, jobs);
}

std::shared_ptr<const Folder> folderOf(const fs::path &folder, const ProgramOptions &options, const KnownNames &known) {
  const auto list = [&] { return programsIn(folder, options.open, known); };
  return options.store ? options.store->folder(folder, list) : std::make_shared<const Folder>(list());
}

OpenedFile openedFileOf(const WorkItem &item) {
  return {item.shown, item.path, item.source, {item.profile, &item.profile->dialect}};
}

bool isNamed(const Program &program, std::string_view wanted) {
  const std::string name = toUpper(program.name.number ? std::to_string(*program.name.number) : program.name.text);
  const std::string asked = toUpper(wanted);
  return !name.empty() && (asked == name || asked == "O" + name || asked == "<" + name + ">" ||
                           asked == toUpper(toString(program.name)));
}

} // namespace

std::vector<const FileContracts *> Project::contracts() const {
  std::vector<const FileContracts *> all;
  for (const auto &file : files)
    all.push_back(&file->contracts);
  return all;
}

Project loadProject(std::span<const WorkItem> items, const LoadOptions &options) {
  Project project;
  std::vector<std::shared_ptr<ProjectFile>> files(items.size());
  parallelFor(items.size(), options.jobs, [&](std::size_t i) {
    const OpenedFile file = openedFileOf(items[i]);
    files[i] = items[i].foreign == nullptr ? readFile(file, options.open) : unreadFile(file);
  });
  if (options.infer == InferMachines::Yes)
    project.inferred = inferMachineSettings(files);
  project.files.assign(files.begin(), files.end());
  connect(project, options.graphs, options.jobs);
  return project;
}

std::unique_ptr<const Project> loadProject(const WorkItem &item, const ProgramOptions &options,
                                           const KnownNames &known) {
  const auto read = [&](const OpenedFile &file) {
    return options.store ? options.store->read(file, options.open) : readFile(file, options.open);
  };
  auto project = std::make_unique<Project>();
  const OpenedFile first = openedFileOf(item);
  project->files.push_back(read(first));
  const bool wantsFolder =
      options.folder == ProgramOptions::Folder::Always || !project->files.front()->model.calls.empty();
  if (!item.path.empty() && wantsFolder) {
    const std::shared_ptr<const Folder> folder = folderOf(item.path.parent_path(), options, known);
    for (const auto &[path, source] : *folder)
      if (path.filename() != item.path.filename())
        project->files.push_back(read({pathText(path), path, source, first.dialect}));
  }
  if (!item.path.empty())
    project->missingContracts = missingContracts(project->files, item.path.parent_path(), options.open);
  connect(*project, LoadGraphs::Yes, 1);
  return project;
}

Result<std::unique_ptr<const Project>> loadProject(const ProgramOptions &options, const KnownNames &known) {
  std::error_code ignored;
  if (!options.piped && fs::is_directory(options.path, ignored))
    return Error{options.path + ": is a folder; name the program to start"};
  CheckOptions files;
  files.piped = options.piped;
  files.control = options.control;
  files.config = options.config;
  files.open = options.open;
  files.jobs = 1;
  if (!options.piped)
    files.paths = {options.path};
  const Workload workload = loadWorkload(files, known);
  if (workload.items.empty() || !workload.errors.empty())
    return whyNothing(workload, options.path);
  const WorkItem &item = workload.items.front();
  if (item.foreign)
    return Error{fmt::format("{}: this is {}, which Feedhold does not read", item.shown, item.foreign->name)};
  return loadProject(item, options, known);
}

std::optional<Callee> startOf(const Project &project, const std::optional<std::string> &name) {
  const ProgramModel &model = project.files.front()->model;
  for (std::size_t i = 0; i < model.programs.size(); ++i) {
    const ProgramId id(i);
    const Program &program = model.programs[id];
    if (name ? isNamed(program, *name) : !program.within)
      return Callee{FileId(0), project.set->file(FileId(0)).cfg.entryOf(id), id};
  }
  return std::nullopt;
}

} // namespace feedhold
