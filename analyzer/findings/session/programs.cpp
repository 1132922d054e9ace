// Opens a program as `check` does, then its folder when it calls anything.
#include "findings/session/programs.h"

#include "base/support/text.h"
#include "findings/session/content.h"
#include "findings/session/discovery.h"
#include "findings/session/file_memory.h"
#include "findings/session/sidecars.h"
#include "language/parse/parse.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold {

namespace fs = std::filesystem;

namespace {

FileMemory::Reading readAnew(const std::string &shown, const fs::path &path, const SourceFile &source,
                             const Dialect &dialect, const std::shared_ptr<const OpenTexts> &open) {
  SyntaxTree tree = parse(source, dialect);
  ProgramModel model = resolve(source, tree, dialect);
  std::vector<Sidecar> sidecars = sidecarsOf(path, model, open);
  FileContracts contracts = readContracts(source, tree, model, dialect, sidecars);
  return {std::make_shared<const LoadedFile>(
              LoadedFile{shown, path, source, std::move(tree), std::move(model), std::move(contracts)}),
          std::move(sidecars)};
}

std::shared_ptr<const LoadedFile> read(const std::string &shown, const fs::path &path, const SourceFile &source,
                                       const Dialect &dialect, const ProgramsWish &wish) {
  const auto anew = [&] { return readAnew(shown, path, source, dialect, wish.open); };
  if (wish.memory == nullptr || wish.open == nullptr || path.empty()) // the text of a mapped file changes with it
    return anew().file;
  return wish.memory->reading(path, source, dialect, wish.open, anew);
}

/// The files beside `path` that are programs by their names and their looks, by name.
std::vector<std::pair<fs::path, SourceFile>> neighboursOf(const fs::path &path, const ProgramsWish &wish,
                                                          const KnownNames &known) {
  const fs::path folder = path.parent_path().empty() ? fs::path(".") : path.parent_path();
  std::vector<fs::path> names;
  std::error_code error; // a folder that cannot be listed has no other programs for us
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code ignored;
    const std::string name = at->path().filename().generic_string();
    if (name != path.filename() && !name.starts_with('.') && kindOfFileName(name) && at->is_regular_file(ignored))
      names.push_back(path.parent_path() / name);
  }
  std::sort(names.begin(), names.end());
  std::vector<std::pair<fs::path, SourceFile>> neighbours;
  for (const fs::path &name : names) {
    Result<SourceFile> source = openSource(name, wish.open);
    if (!source || whyNotText(source.value().text()))
      continue;
    if (guessLanguage(source.value().text(), name.generic_string(), known.dialects).looksLikeProgram)
      neighbours.emplace_back(name, source.take());
  }
  return neighbours;
}

Error whyNothing(const Workload &workload, const std::string &path) {
  if (!workload.errors.empty())
    return {fmt::format("{}: {}", workload.errors.front().path, workload.errors.front().message)};
  const std::string reason = workload.skipped.empty() ? "no program" : workload.skipped.front().reason;
  return {fmt::format("{}: {}", path, reason)};
}

void connect(LoadedPrograms &programs) {
  std::vector<ProgramFile> files;
  std::vector<ModelledFile> models;
  for (std::size_t i = 0; i < programs.files.size(); ++i) {
    const LoadedFile &file = *programs.files[i];
    files.push_back({FileId(i), &file.source, &file.tree, &file.model, &programs.dialect});
    models.push_back(
        {FileId(i), file.path.parent_path().generic_string(), file.path.stem().generic_string(), &file.model});
  }
  programs.set.emplace(std::move(files), CallGraph(std::move(models)));
}

bool isNamed(const Program &program, std::string_view wanted) {
  const std::string name = toUpper(program.name.number ? std::to_string(*program.name.number) : program.name.text);
  const std::string asked = toUpper(wanted);
  return !name.empty() && (asked == name || asked == "O" + name || asked == "<" + name + ">");
}

} // namespace

Result<std::unique_ptr<const LoadedPrograms>> loadPrograms(const ProgramsWish &wish, const KnownNames &known) {
  std::error_code ignored;
  if (!wish.piped && fs::is_directory(wish.path, ignored))
    return Error{wish.path + ": is a folder; name the program to start"};
  CheckOptions options;
  options.piped = wish.piped;
  options.dialect = wish.dialect;
  options.config = wish.config;
  options.open = wish.open;
  options.jobs = 1;
  if (!wish.piped)
    options.paths = {wish.path};
  Workload workload = loadWorkload(options, known);
  if (workload.items.empty() || !workload.errors.empty())
    return whyNothing(workload, wish.path);
  WorkItem &item = workload.items.front();
  if (item.foreign)
    return Error{fmt::format("{}: this is {}, which is not read here", item.shown, item.foreign->name)};

  auto programs = std::make_unique<LoadedPrograms>();
  programs->dialect = item.profile->dialect;
  programs->files.push_back(read(item.shown, item.path, item.source, programs->dialect, wish));
  const bool wantsFolder = wish.folder == ProgramsWish::Folder::Always || !programs->files.front()->model.calls.empty();
  if (!wish.piped && wantsFolder)
    for (const auto &[path, source] : neighboursOf(item.path, wish, known))
      programs->files.push_back(read(path.generic_string(), path, source, programs->dialect, wish));
  connect(*programs);
  return std::unique_ptr<const LoadedPrograms>(std::move(programs));
}

std::optional<Callee> startOf(const LoadedPrograms &programs, const std::optional<std::string> &name) {
  const ProgramModel &model = programs.files.front()->model;
  for (std::size_t i = 0; i < model.programs.size(); ++i) {
    const ProgramId id(i);
    const Program &program = model.programs[id];
    if (name ? isNamed(program, *name) : !program.within)
      return Callee{FileId(0), programs.set->file(FileId(0)).cfg.entryOf(id), id};
  }
  return std::nullopt;
}

} // namespace feedhold
