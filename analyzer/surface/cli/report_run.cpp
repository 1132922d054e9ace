#include "surface/cli/report_run.h"

#include "base/source/path_text.h"
#include "dialects/registry.h"
#include "findings/session/session.h"
#include "proof/smt/solver.h"
#include "rules/registry.h"
#include "surface/cli/bundle_folder.h"
#include "surface/cli/self_check.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold {

namespace fs = std::filesystem;

namespace {

KnownNames known() { return {allDialects(), allRules()}; }

std::optional<fs::path> configFor(const ConfigOptions &options, const fs::path &file) {
  if (options.source == ConfigSource::Named)
    return options.file;
  ConfigFinder finder(options, known());
  const Config *config = finder.forFolder(file.parent_path());
  return config == nullptr || config->folder.empty() ? std::nullopt : std::optional(config->folder / kConfigFileName);
}

bool isOpen(const prove::Obligation &obligation) { return !prove::holds(obligation.verdict); }

/// The search for clauses is no part of the evidence, so that it is made apart.
void addGuards(ProofsResult &proofs, const ProofOptions &made) {
  ProofOptions options = made;
  options.steps = KeepSteps::No;
  options.prove.guards = prove::InferGuards::Yes;
  options.files.only.emplace();
  for (const ProvedFile &file : proofs.files)
    if (std::any_of(file.programs.begin(), file.programs.end(), [](const ProvedProgram &program) {
          return std::any_of(program.proof.obligations.begin(), program.proof.obligations.end(), isOpen);
        }))
      options.files.only->insert(file.file().shown);
  if (options.files.only->empty())
    return;
  const ProofsResult guarded = proveAll(options, known());
  proofs.errors.insert(proofs.errors.end(), guarded.errors.begin(), guarded.errors.end());
  std::map<std::pair<std::string, std::string>, const prove::Guard *> guards; // by file and obligation
  for (const ProvedFile &file : guarded.files)
    for (const ProvedProgram &program : file.programs)
      for (const prove::Obligation &obligation : program.proof.obligations)
        if (obligation.verdict.guard())
          guards[{file.file().shown, obligation.id}] = obligation.verdict.guard();
  for (ProvedFile &file : proofs.files)
    for (ProvedProgram &program : file.programs)
      for (prove::Obligation &obligation : program.proof.obligations)
        if (const auto guard = guards.find({file.file().shown, obligation.id}); guard != guards.end())
          obligation.verdict.setGuard(*guard->second);
}

std::vector<std::string> solvers() {
  return {smt::z3Version().value_or("Z3 is not installed"), smt::cvc5Version().value_or("cvc5 is not installed")};
}

} // namespace

/// Absolute paths: what is said of a file must not depend on the folder in which somebody stands.
CheckOptions filesOfReport(const ReportOptions &options, unsigned jobs) {
  CheckOptions files;
  for (const fs::path &path : options.paths)
    files.paths.push_back(pathText(normalPath(absolutePath(path))));
  files.control = options.reading.control;
  if (options.reading.isolated)
    files.config.source = ConfigSource::None;
  else if (options.reading.config)
    files.config = {ConfigSource::Named, normalPath(absolutePath(*options.reading.config))};
  files.jobs = jobs;
  return files;
}

/// An installation that fails its self-check releases nothing.
ReportRun runReport(const ReportOptions &options, const fs::path &folder, unsigned jobs, const ReportPart &part) {
  std::vector<SelfCheckStep> steps = selfCheck();
  if (!passed(steps)) {
    ReportRun failed;
    failed.problems.push_back({"this installation", "the self-check failed; `feedhold self-check` shows how"});
    return failed;
  }
  ProofOptions proofOptions{.files = filesOfReport(options, jobs)};
  proofOptions.files.only = part.files;
  proofOptions.answers = part.answers;
  proofOptions.prove.only = options.reading.only;
  keepEvidence(proofOptions);
  ProofsResult proofs = proveAll(proofOptions, known());
  ReportRun run;
  if (!part.files && proofs.files.empty() && proofs.errors.empty() && !proofs.skipped.empty())
    proofs.errors.push_back({proofs.skipped.front().path, "nothing to prove: " + proofs.skipped.front().reason});
  run.isProved = true;
  run.costs = costsOf(proofs);
  run.problems = proofs.errors;
  if (!run.problems.empty())
    return run;
  addGuards(proofs, proofOptions);
  run.problems = proofs.errors;
  const CheckResult findings = check(proofOptions.files, known(), part.answers);
  if (part.answers.given != nullptr) // of a file without an answer the report would say that nothing was found
    run.problems.insert(run.problems.end(), findings.errors.begin(), findings.errors.end());
  if (!run.problems.empty())
    return run;
  for (const ProvedFile &file : proofs.files)
    for (const ProvedProgram &program : file.programs) {
      run.counts.add(program.proof);
      ++run.programs;
    }
  run.status = releaseStatusOf(proofs);
  if (part.files)
    return run;
  run.report = makeReport({.options = options,
                           .proofs = proofs,
                           .findings = findings,
                           .dialects = allDialects(),
                           .configOf = [&](const fs::path &file) { return configFor(proofOptions.files.config, file); },
                           .version = FEEDHOLD_VERSION,
                           .solvers = solvers(),
                           .selfCheck = std::move(steps),
                           .folder = folder,
                           .jobs = jobs});
  return run;
}

} // namespace feedhold
