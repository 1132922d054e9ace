// Drafts for all programs of a set of files, and writes them.
#include "findings/draft/draft.h"

#include "base/source/path_text.h"
#include "base/source/write_file.h"
#include "base/support/parallel.h"
#include "findings/draft/sidecar_text.h"
#include "proof/decide/cancel.h"

#include <fmt/format.h>

#include <atomic>
#include <set>

namespace feedhold {

namespace {

namespace fs = std::filesystem;

struct DraftJob {
  const Project *project;
  ProgramId program;
  DraftedProgram *result;
};

std::string readText(const fs::path &path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored))
    return {};
  const Result<SourceFile> source = SourceFile::open(path);
  return source ? std::string(source.value().text()) : std::string();
}

/// `O9100.contract`; `part.nc.contract` where the program has no number, or where another file of the folder has a
/// program with the same one.  Absent: no name says which program is meant.
std::optional<fs::path> placeFor(const Project &project, ProgramId program) {
  const ProjectFile &file = project.file(FileId(0));
  const auto number = file.model.programs[program].name.number;
  if (number && project.callGraph.namesakes({FileId(0), program}).empty())
    return file.path.parent_path() / fmt::format("O{:04}.contract", *number);
  if (program != ProgramId(0))
    return std::nullopt;
  return file.path.parent_path() / (pathText(file.path.filename()) + ".contract");
}

std::string whyUntouched(const Project &project, ProgramId program, bool update) {
  const ProjectFile &file = project.file(FileId(0));
  const Program &what = file.model.programs[program];
  if (what.isEncrypted)
    return "it is encrypted";
  if (what.within)
    return "subroutines inside a program have no contract files";
  if (file.contracts.of(program) && !update)
    return "it has a contract; `--update` adds to it and keeps what you wrote";
  return {};
}

DraftedProgram prepared(const Project &project, ProgramId program, bool update) {
  const ProjectFile &file = project.file(FileId(0));
  const ProgramName &name = file.model.programs[program].name;
  DraftedProgram drafted;
  drafted.file = file.shown;
  drafted.program = name.empty() ? file.path.filename().string() : toString(name);
  drafted.untouched = whyUntouched(project, program, update);
  const auto place = placeFor(project, program);
  if (place)
    drafted.place = *place;
  else if (drafted.untouched.empty())
    drafted.untouched = "another program has its number, and no name of a contract file means this one alone";
  std::error_code ignored;
  if (drafted.untouched.empty() && !update && fs::exists(drafted.place, ignored))
    drafted.untouched =
        fmt::format("{} is there; `--update` adds to it and keeps what you wrote", pathText(drafted.place.filename()));
  if (drafted.untouched.empty())
    drafted.before = drafted.after = readText(drafted.place);
  return drafted;
}

void draftOne(const DraftJob &job, const DraftOptions &options) {
  const prove::StopScope scope(options.stop);
  const std::string kept = draft::withoutDrafts(job.result->before);
  try {
    prove::throwIfCancelled();
    job.result->draft = draft::draftOf(*job.project, job.program, kept, options.prove);
    job.result->after = draft::withDrafts(kept, job.result->draft.clauses);
  } catch (const prove::Cancelled &) {
    job.result->draft = {}; // draftAll sees it, too
  }
}

} // namespace

DraftResult draftAll(const DraftOptions &options, const KnownNames &known) {
  Workload workload = loadWorkload(options.files, known);
  DraftResult result{{}, std::move(workload.skipped), std::move(workload.errors)};
  FileStore store(FileStore::Lifetime::Run);
  const ProgramOptions withFolder{
      .path = {}, .open = options.files.open, .folder = ProgramOptions::Folder::Always, .store = &store};
  std::vector<std::unique_ptr<const Project>> projects;
  std::vector<std::pair<const Project *, ProgramId>> programs;
  for (const WorkItem &item : workload.items) {
    if (item.foreign != nullptr) {
      result.skipped.push_back({item.shown, fmt::format("{}, which Feedhold does not read", item.foreign->name)});
      continue;
    }
    projects.push_back(loadProject(item, withFolder, known));
    for (std::size_t i = 0; i < projects.back()->files.front()->model.programs.size(); ++i)
      programs.emplace_back(projects.back().get(), ProgramId(i));
  }
  for (const auto &[project, program] : programs)
    result.programs.push_back(prepared(*project, program, options.update));
  if (!options.program.empty())
    for (DraftedProgram &each : result.programs)
      if (each.program != options.program && each.untouched.empty())
        each.untouched = "another program is asked for";
  std::vector<DraftJob> jobs;
  for (std::size_t i = 0; i < programs.size(); ++i)
    if (result.programs[i].untouched.empty())
      jobs.push_back({programs[i].first, programs[i].second, &result.programs[i]});
  std::atomic<std::size_t> done{0};
  parallelFor(jobs.size(), options.files.jobs, [&](std::size_t i) {
    draftOne(jobs[i], options);
    if (options.files.progress)
      options.files.progress(++done, jobs.size());
  });
  if (options.stop.stop_requested())
    result.programs.clear();
  return result;
}

std::optional<fs::path> draftPlace(const Project &project, ProgramId program) {
  const DraftedProgram drafted = prepared(project, program, false);
  return drafted.untouched.empty() ? std::optional(drafted.place) : std::nullopt;
}

std::vector<PathProblem> writeDrafts(const std::vector<DraftedProgram> &drafts) {
  std::vector<PathProblem> problems;
  for (const DraftedProgram &drafted : drafts)
    if (drafted.isChanged())
      if (const std::optional<Error> error = saveFile(drafted.place, drafted.after))
        problems.push_back({pathText(drafted.place), error->message});
  return problems;
}

} // namespace feedhold
