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

/// A clause that was left out for a mistake in it would be a promise that nobody proves, and one about a variable that
/// the program does not read was meant for another variable.
std::optional<PathProblem> contractMistake(const ProjectFile &file, ProgramId program) {
  const Contract *contract = file.contracts.of(program);
  const std::vector<ContractIssue> &issues = file.contracts.issues;
  const bool namesOthers = std::any_of(issues.begin(), issues.end(), [&](const ContractIssue &issue) {
    return issue.kind == ContractIssueKind::UnusedVariable && issue.program == program;
  });
  if (contract == nullptr || (contract->isSound && !namesOthers))
    return std::nullopt;
  return PathProblem{file.shown,
                     fmt::format("the contract of {} has errors, so nothing is proved; `feedhold check` reports them",
                                 toString(file.model.programs[program].name))};
}

/// Of programs that are in none of the files.  That they do not use a variable is not known of any.
void addMistakes(const MissingContracts &missing, std::vector<PathProblem> &errors) {
  for (const auto &[number, contracts] : missing) {
    const Contract *contract = contracts->of(ProgramId(0));
    const auto mistake = std::ranges::find_if(
        contracts->issues, [](const ContractIssue &issue) { return issue.kind != ContractIssueKind::UnusedVariable; });
    if (!contract || contract->isSound || mistake == contracts->issues.end())
      continue;
    const SourceFile &source = contracts->source(mistake->source);
    const bool isKnown =
        std::ranges::any_of(errors, [&](const PathProblem &known) { return known.path == std::string(source.path()); });
    if (!isKnown)
      errors.push_back(
          {std::string(source.path()),
           fmt::format("line {}: a mistake in this clause, so that nothing is taken from the contract of O{}",
                       source.lineOf(mistake->span.begin), number)});
  }
}

struct Job {
  const Project *project;
  ProvedProgram *result;
  bool isMissing = false; // among the answers that are given
};

/// All programs of a file together have fewer steps than one large program, since each of them costs something before
/// the first step: a file is given up in 20 seconds.  Each has its share, however they are spread over threads.
std::uint64_t stepsFor(std::uint64_t stepsOfOne, std::size_t programsInFile) {
  return programsInFile <= 1 ? stepsOfOne : stepsOfOne * 4 / 5 / programsInFile;
}

/// Of the steps of a program with a contract.  What needs more without one is seldom proved at all: twice as many steps
/// complete no more of 156 files of other authors, and half as many lose some.
constexpr std::uint64_t kShareWithoutContract = 10;
/// Of the work of Z3 in one question: arcs of any size take seconds of it, and are not decided.
constexpr std::uint64_t kShareOfZ3WithoutContract = 40;

void proveAnew(const Job &job, const prove::ProveOptions &options) {
  const Project &project = *job.project;
  const ProgramId program = job.result->program;
  const Callee callee{FileId(0), project.set->file(FileId(0)).cfg.entryOf(program), program};
  prove::ProveOptions own = options;
  own.steps = stepsFor(options.steps, project.file(FileId(0)).model.programs.size());
  if (!project.file(FileId(0)).contracts.of(program)) {
    own.steps = std::min(own.steps, options.steps / kShareWithoutContract);
    own.budget.z3 /= kShareOfZ3WithoutContract;
  }
  own.contractsOf = project.contracts();
  for (const auto &[number, contracts] : project.missingContracts)
    own.missingContracts.emplace(number, contracts.get());
  job.result->proof = prove::prove(*project.set, callee, &project.file(FileId(0)).contracts, own);
}

/// The part that holds the answers names the build; its solver is no matter of who joins the parts.
std::string answerKey(const Job &job, const ProofOptions &options) {
  return (options.steps == KeepSteps::Yes ? "evidence " : "proof ") +
         proofKey("", *job.project, job.result->program, options.prove);
}

void takeGiven(Job &job, const Answers &given, const ProofOptions &options) {
  const std::string *record = given.find(answerKey(job, options));
  if (record != nullptr)
    job.result->record = std::make_shared<const std::string>(*record);
  std::optional<RecordedProof> read =
      record == nullptr ? std::nullopt : readProofRecord(*job.result->record, *job.project->set);
  job.isMissing = !read;
  if (!read)
    return;
  job.result->proof = std::move(read->proof);
  job.result->steps = std::move(read->steps);
}

void proveOrRecall(const Job &job, const ProofOptions &options) {
  if (!options.cache && options.steps == KeepSteps::Yes) {
    prove::CertificateLog log;
    proveAnew(job, options.prove);
    job.result->steps = log.take();
    return;
  }
  if (!options.cache) {
    proveAnew(job, options.prove);
    return;
  }
  const std::string key = proofKey(proverOf(*options.cache), *job.project, job.result->program, options.prove);
  if (auto remembered = recall(*options.cache, key, *job.project->set)) {
    job.result->record = std::move(remembered->record);
    job.result->proof = std::move(remembered->proof);
    return;
  }
  const std::uint64_t failures = failedChildren();
  proveAnew(job, options.prove);
  // A solver that is missing today may be there tomorrow, and one that had to be stopped may be in time.
  if (failedChildren() == failures && job.result->proof.contradictions.empty())
    remember(*options.cache, key, job.result->proof);
}

void answer(Job &job, const ProofOptions &options) {
  if (options.answers.given != nullptr) {
    takeGiven(job, *options.answers.given, options);
    return;
  }
  proveOrRecall(job, options);
  if (options.answers.kept != nullptr)
    options.answers.kept->add(
        answerKey(job, options),
        writeProofRecord(job.result->proof, options.steps == KeepSteps::Yes ? &job.result->steps : nullptr));
}

void proveUnlessStopped(Job &job, const ProofOptions &options) {
  const prove::StopScope scope(options.stop);
  try {
    prove::throwIfCancelled();
    answer(job, options);
  } catch (const prove::Cancelled &) {
    // proveAll sees it, too.
  }
}

} // namespace

ProofsResult proveAll(const ProofOptions &options, const KnownNames &known) {
  Workload workload = loadWorkload(options.files, known);
  ProofsResult result{{}, std::move(workload.skipped), std::move(workload.errors)};
  std::vector<const WorkItem *> items;
  for (const WorkItem &item : workload.items)
    if (options.files.only && !options.files.only->contains(item.shown))
      continue;
    else if (item.foreign != nullptr)
      result.skipped.push_back({item.shown, fmt::format("{}, which Feedhold does not read", item.foreign->name)});
    else
      items.push_back(&item);

  FileStore store(FileStore::Lifetime::Run); // the files of one folder belong to many projects
  const ProgramOptions withFolder{.path = {}, .open = options.files.open, .store = &store};
  std::vector<std::unique_ptr<const Project>> projects(items.size());
  parallelFor(items.size(), options.files.jobs,
              [&](std::size_t i) { projects[i] = loadProject(*items[i], withFolder, known); });
  for (std::unique_ptr<const Project> &project : projects) {
    addMistakes(project->missingContracts, result.errors);
    ProvedFile &file = result.files.emplace_back(ProvedFile{std::move(project), {}});
    for (std::size_t program = 0; program < file.file().model.programs.size(); ++program)
      if (const Program &each = file.file().model.programs[ProgramId(program)]; each.isEncrypted)
        result.skipped.push_back(
            {file.file().shown, fmt::format("`{}` is encrypted: nothing is claimed of it", toString(each.name))});
      else if (options.which == ProofOptions::Which::WithContract &&
               file.file().contracts.of(ProgramId(program)) == nullptr)
        continue;
      else if (auto mistake = contractMistake(file.file(), ProgramId(program)))
        result.errors.push_back(std::move(*mistake));
      else
        file.programs.push_back({ProgramId(program), {}});
  }

  std::vector<Job> jobs;
  for (ProvedFile &file : result.files)
    for (ProvedProgram &program : file.programs)
      jobs.push_back({file.project.get(), &program});
  std::atomic<std::size_t> done{0};
  parallelFor(jobs.size(), options.files.jobs, [&](std::size_t i) {
    proveUnlessStopped(jobs[i], options);
    if (options.files.progress)
      options.files.progress(++done, jobs.size());
  });
  for (const Job &job : jobs)
    if (job.isMissing)
      result.errors.push_back({job.project->file(FileId(0)).shown, kNoAnswer});
  if (options.stop.stop_requested())
    result.files.clear(); // a program that was not proved to its end would look like one without mistakes
  return result;
}

FileCosts costsOf(const ProofsResult &result) {
  FileCosts costs;
  for (const ProvedFile &file : result.files) {
    std::uint64_t cost = 1;
    for (const ProvedProgram &program : file.programs)
      for (const prove::Obligation &obligation : program.proof.obligations)
        cost += obligation.effort;
    costs.emplace(file.file().shown, cost);
  }
  return costs;
}

} // namespace feedhold
