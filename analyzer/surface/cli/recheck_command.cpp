// `feedhold recheck DIR`: whether a bundle of proofs, or the report of `certify`, still says what proving the same now
// says, and whether its evidence holds.
#include "base/source/path_text.h"
#include "dialects/registry.h"
#include "proof/smt/solver.h"
#include "rules/registry.h"
#include "surface/cli/bundle_folder.h"
#include "surface/cli/commands.h"
#include "surface/cli/report_run.h"
#include "surface/cli/shared_options.h"
#include "surface/cli/terminal.h"
#include "surface/evidence/evidence_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>

namespace feedhold {

namespace {

struct RecheckArguments {
  std::string folder;
  std::string against;
  std::string solvers = "all";
  unsigned jobs = 0;
  bool quiet = false;
  bool verbose = false;
};

ProofOptions optionsFrom(const BundleOrigin &origin, const RecheckArguments &arguments) {
  ProofOptions options;
  for (const std::filesystem::path &path : origin.paths)
    options.files.paths.push_back(pathText(path));
  options.files.control = origin.reading.control;
  if (origin.reading.isolated)
    options.files.config.source = ConfigSource::None;
  else if (origin.reading.config)
    options.files.config = {ConfigSource::Named, *origin.reading.config};
  options.files.jobs = arguments.jobs;
  options.prove.only = origin.reading.only;
  keepEvidence(options);
  return options;
}

std::optional<std::string> complaintAbout(const BundleOrigin &origin) {
  if (origin.paths.empty())
    return "it contains no proofs";
  return origin.reading.control.dialect ? complaintAboutDialect(*origin.reading.control.dialect, allDialects())
                                        : std::nullopt;
}

std::string counted(std::size_t count, std::string_view thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

/// What was found, and how much was looked at.
struct Findings {
  std::vector<std::string> problems;
  std::vector<Question> questions;

  void add(std::vector<std::string> lines) { problems.insert(problems.end(), lines.begin(), lines.end()); }
};

/// `folder`: of the evidence, with a `/`, or empty.
Findings evidenceFindings(const Bundle &evidence, std::string_view folder, const RecheckArguments &arguments) {
  const AskSolvers asked = arguments.solvers == "all" ? AskSolvers::Always : AskSolvers::WhereNeeded;
  Findings findings;
  findings.questions = checkEvidence(evidence, {asked, arguments.jobs});
  for (const Question &question : findings.questions)
    if (!question.holds())
      findings.problems.push_back(fmt::format("`{}{}`: {}", folder, question.file, question.problem));
  return findings;
}

std::size_t countOf(const std::vector<Question> &questions, SolverSays Question::*solver, SolverSays says) {
  return static_cast<std::size_t>(std::count_if(questions.begin(), questions.end(),
                                                [&](const Question &question) { return question.*solver == says; }));
}

/// `z3 4.8.12 refutes 120, gives no answer to 3`
std::string agreementOf(std::string_view name, const std::vector<Question> &questions, SolverSays Question::*solver) {
  const std::size_t silent = countOf(questions, solver, SolverSays::NoAnswer);
  const std::size_t contradicts = countOf(questions, solver, SolverSays::Satisfiable);
  std::string text = fmt::format("{} refutes {}", name, countOf(questions, solver, SolverSays::Refutes));
  if (silent > 0)
    text += fmt::format(", gives no answer on {}", silent);
  if (contradicts > 0)
    text += fmt::format(", finds {} satisfiable", contradicts);
  return text;
}

std::string summaryOf(const std::vector<Question> &questions) {
  const auto followed = static_cast<std::size_t>(
      std::count_if(questions.begin(), questions.end(), [](const Question &question) { return question.isFollowed; }));
  const std::size_t asked = questions.size() - countOf(questions, &Question::z3, SolverSays::NotAsked);
  return fmt::format(
      "evidence: {}, {} verified by the checker, {} asked again ({}; {})\n", counted(questions.size(), "question"),
      counted(followed, "certificate"), asked,
      agreementOf(smt::z3Version().value_or("Z3, which is not installed,"), questions, &Question::z3),
      agreementOf(smt::cvc5Version().value_or("cvc5, which is not installed,"), questions, &Question::cvc5));
}

std::string_view toldOfReport(const Question &question) {
  if (!question.hasCertificate)
    return "";
  return question.isFollowed ? "certificate verified, " : "certificate rejected, ";
}

void printEach(const std::vector<Question> &questions, std::string_view folder) {
  for (const Question &question : questions)
    print(fmt::format("{}{}: {}Z3 {}, cvc5 {}\n", folder, question.file, toldOfReport(question), nameOf(question.z3),
                      nameOf(question.cvc5)));
}

int present(const Findings &findings, const std::string &told, std::string_view folder,
            const RecheckArguments &arguments, int whenSame) {
  if (arguments.verbose)
    printEach(findings.questions, folder);
  for (const std::string &problem : findings.problems)
    print(problem + "\n");
  if (!arguments.quiet)
    print(fmt::format("{}: {}\n{}",
                      findings.problems.empty() ? "no differences" : counted(findings.problems.size(), "difference"),
                      told, summaryOf(findings.questions)));
  return findings.problems.empty() ? whenSame : kExitFindings;
}

void addVersion(Findings &findings, const std::string &version) {
  if (version != FEEDHOLD_VERSION)
    findings.problems.push_back(
        fmt::format("it was made by feedhold {}, but this is feedhold {}", version, FEEDHOLD_VERSION));
}

Result<int> recheckBundle(const Bundle &stored, const RecheckArguments &arguments) {
  const Result<BundleOrigin> origin = originOf(stored, arguments.folder);
  if (!origin)
    return origin.error();
  if (const auto complaint = complaintAbout(origin.value()))
    return Error{*complaint};

  Findings findings = evidenceFindings(stored, "", arguments);
  addVersion(findings, origin.value().version);
  const ProofsResult result = proveAll(optionsFrom(origin.value(), arguments), {allDialects(), allRules()});
  for (const PathProblem &problem : result.errors)
    findings.problems.push_back(problem.path + ": " + problem.message);
  findings.add(differences(stored, makeBundle(result, origin.value().reading, FEEDHOLD_VERSION, arguments.folder)));
  std::size_t obligations = 0;
  for (const ProvedFile &file : result.files)
    for (const ProvedProgram &program : file.programs)
      obligations += program.proof.obligations.size();
  return present(findings, counted(obligations, "obligation") + " proved again", "", arguments, kExitClean);
}

// ---- the report of `certify` ----

/// Programs that lie elsewhere are compared, and not proved again: what they call may be anywhere.
Result<int> recheckReport(const Bundle &stored, const RecheckArguments &arguments) {
  const Result<ReportOrigin> origin = reportOrigin(stored, arguments.folder);
  if (!origin)
    return origin.error();
  if (const auto &dialect = origin.value().options.reading.control.dialect)
    if (const auto complaint = complaintAboutDialect(*dialect, allDialects()))
      return Error{*complaint};
  Findings findings = evidenceFindings(evidenceOf(stored), kEvidenceFolder, arguments);
  addVersion(findings, origin.value().version);
  findings.add(inconsistencies(stored));
  const auto place = arguments.against.empty() ? std::nullopt : std::optional<std::filesystem::path>(arguments.against);
  const SourceCheck sources = checkSources(stored, arguments.folder, place);
  findings.add(sources.changed);
  const std::string compared = counted(sources.same, "source") + " unchanged";
  if (place || (sources.same == 0 && sources.changed.empty())) {
    for (const std::string &gone : sources.gone)
      printAside(fmt::format("`{}` is missing and was not compared\n", gone));
    return present(findings, compared + ", nothing proved again", kEvidenceFolder, arguments, kExitUnknown);
  }
  for (const std::string &gone : sources.gone)
    findings.problems.push_back(fmt::format("`{}` was read for the proof but is missing now", gone));
  const ReportRun run = runReport(origin.value().options, arguments.folder, arguments.jobs);
  for (const PathProblem &problem : run.problems)
    findings.problems.push_back(problem.path + ": " + problem.message);
  if (run.problems.empty()) {
    findings.add(differences(evidenceOf(stored), evidenceOf(run.report)));
    findings.add(reportDifferences(stored, run.report));
  }
  return present(findings, fmt::format("{}, {} proved again", compared, counted(run.counts.all(), "obligation")),
                 kEvidenceFolder, arguments, kExitClean);
}

Result<int> recheck(const RecheckArguments &arguments) {
  const Result<Bundle> stored = readBundle(arguments.folder);
  if (!stored)
    return stored.error();
  if (stored.value().contains(std::string(kReportDocument)))
    return recheckReport(stored.value(), arguments);
  if (!stored.value().contains(std::string(kBundleIndex)))
    return Error{fmt::format("contains neither a report nor proofs: no {} and no {}", kReportDocument, kBundleIndex)};
  if (!arguments.against.empty())
    return Error{"--against works only with reports of `feedhold certify`"};
  return recheckBundle(stored.value(), arguments);
}

int recheckOrComplain(const RecheckArguments &arguments) {
  const Result<int> exitCode = recheck(arguments);
  if (exitCode)
    return exitCode.value();
  printError(arguments.folder + ": " + exitCode.error().message);
  return kExitCouldNotRun;
}

} // namespace

Command addRecheckCommand(CLI::App &parent) {
  CLI::App *app =
      parent.add_subcommand("recheck", "verify a release report or certificates, and report every difference");
  const auto arguments = std::make_shared<RecheckArguments>();
  app->add_option("folder", arguments->folder, "folder written by `certify -o` or `prove --certificate`")
      ->type_name("FOLDER")
      ->required();
  app->add_option("--against", arguments->against,
                  "for reports: compare with the programs in this folder when the originals are unavailable")
      ->type_name("FOLDER");
  app->add_option("--solvers", arguments->solvers,
                  "ask Z3 and cvc5 all questions, or only those without a certificate (default: all)")
      ->type_name("WHICH")
      ->check(CLI::IsMember({"all", "needed"}));
  addJobs(*app, arguments->jobs);
  app->add_flag("-v,--verbose", arguments->verbose, "print the result of each question");
  addQuiet(*app, arguments->quiet, "print differences only");
  return {app, [arguments] { return recheckOrComplain(*arguments); }};
}

} // namespace feedhold
