// Finds the files as `check` does, loads each with its folder, then proves all programs in parallel.
#include "findings/session/proofs.h"

#include "base/support/parallel.h"
#include "base/support/process.h"
#include "proof/decide/cancel.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>

namespace feedhold {

namespace {

using Loaded = Result<std::unique_ptr<const LoadedPrograms>>;

Loaded load(const ProofsWish &wish, const WorkItem &item, const KnownNames &known) {
  ProgramsWish programs{
      .path = item.shown, .dialect = wish.files.dialect, .config = wish.files.config, .open = wish.files.open};
  if (item.path.empty())
    programs.piped = wish.files.piped;
  return loadPrograms(programs, known);
}

/// A clause that was left out for a mistake in it would be a promise that nobody proves, and one about a variable that
/// the program does not read was meant for another variable.
std::optional<PathProblem> contractMistake(const LoadedFile &file, ProgramId program) {
  const Contract *contract = file.contracts.of(program);
  const std::vector<ContractIssue> &issues = file.contracts.issues;
  const bool namesOthers = std::any_of(issues.begin(), issues.end(), [&](const ContractIssue &issue) {
    return issue.kind == ContractIssueKind::UnusedVariable && issue.program == program;
  });
  if (contract == nullptr || (contract->isSound && !namesOthers))
    return std::nullopt;
  return PathProblem{file.shown, fmt::format("the contract of {} has mistakes, so that it is not proved; `feedhold "
                                             "check` shows them",
                                             toString(file.model.programs[program].name))};
}

struct Job {
  const LoadedPrograms *loaded;
  ProvedProgram *result;
};

/// All programs of a file together have fewer steps than one large program, since each of them costs something before
/// the first step: a file is given up in 20 seconds.  Each has its share, however they are spread over threads.
std::uint64_t stepsFor(std::uint64_t stepsOfOne, std::size_t programsInFile) {
  return programsInFile <= 1 ? stepsOfOne : stepsOfOne * 4 / 5 / programsInFile;
}

void proveAnew(const Job &job, const prove::ProveOptions &options) {
  const LoadedPrograms &programs = *job.loaded;
  const ProgramId program = job.result->program;
  const Callee callee{FileId(0), programs.set->file(FileId(0)).cfg.entryOf(program), program};
  prove::ProveOptions own = options;
  own.steps = stepsFor(options.steps, programs.file(FileId(0)).model.programs.size());
  for (const auto &file : programs.files)
    own.contractsOf.push_back(&file->contracts);
  job.result->proof = prove::prove(*programs.set, callee, &programs.file(FileId(0)).contracts, own);
}

void proveOrRecall(const Job &job, const ProofsWish &wish) {
  if (!wish.cache && wish.steps == KeepSteps::Yes) {
    prove::CertificateLog log;
    proveAnew(job, wish.prove);
    job.result->steps = log.take();
    return;
  }
  if (!wish.cache) {
    proveAnew(job, wish.prove);
    return;
  }
  const std::string key = proofKey(*wish.cache, *job.loaded, job.result->program, wish.prove);
  if (auto remembered = recall(*wish.cache, key, *job.loaded->set)) {
    job.result->record = std::move(remembered->record);
    job.result->proof = std::move(remembered->proof);
    return;
  }
  const std::uint64_t failures = failedChildren();
  proveAnew(job, wish.prove);
  // A solver that is missing today may be there tomorrow, and one that had to be stopped may be in time.
  if (failedChildren() == failures && job.result->proof.contradictions.empty())
    remember(*wish.cache, key, job.result->proof);
}

void proveUnlessStopped(const Job &job, const ProofsWish &wish) {
  const prove::StopScope scope(wish.stop);
  try {
    prove::throwIfCancelled();
    proveOrRecall(job, wish);
  } catch (const prove::Cancelled &) {
    // proveAll sees it, too.
  }
}

} // namespace

ProofsResult proveAll(const ProofsWish &wish, const KnownNames &known) {
  Workload workload = loadWorkload(wish.files, known);
  ProofsResult result{{}, std::move(workload.skipped), std::move(workload.errors)};
  std::vector<const WorkItem *> items;
  for (const WorkItem &item : workload.items)
    if (item.foreign != nullptr)
      result.skipped.push_back({item.shown, fmt::format("{}, which is not read", item.foreign->name)});
    else
      items.push_back(&item);

  std::vector<std::optional<Loaded>> loaded(items.size());
  parallelFor(items.size(), wish.files.jobs, [&](std::size_t i) { loaded[i] = load(wish, *items[i], known); });
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!*loaded[i]) {
      result.errors.push_back({items[i]->shown, loaded[i]->error().message});
      continue;
    }
    ProvedFile &file = result.files.emplace_back(ProvedFile{loaded[i]->take(), {}});
    for (std::size_t program = 0; program < file.file().model.programs.size(); ++program)
      if (wish.which == ProofsWish::Which::WithContract && file.file().contracts.of(ProgramId(program)) == nullptr)
        continue;
      else if (auto mistake = contractMistake(file.file(), ProgramId(program)))
        result.errors.push_back(std::move(*mistake));
      else
        file.programs.push_back({ProgramId(program), {}});
  }

  std::vector<Job> jobs;
  for (ProvedFile &file : result.files)
    for (ProvedProgram &program : file.programs)
      jobs.push_back({file.loaded.get(), &program});
  std::atomic<std::size_t> done{0};
  parallelFor(jobs.size(), wish.files.jobs, [&](std::size_t i) {
    proveUnlessStopped(jobs[i], wish);
    if (wish.files.progress)
      wish.files.progress(++done, jobs.size());
  });
  if (wish.stop.stop_requested())
    result.files.clear(); // a program that was not proved to its end would look like one without mistakes
  return result;
}

} // namespace feedhold
