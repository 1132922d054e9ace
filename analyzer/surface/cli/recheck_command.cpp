// `feedhold recheck DIR`: whether a bundle of proofs, or the report of `certify`, still says what proving the same now
// says, and whether its evidence holds.
#include "dialects/registry.h"
#include "rules/registry.h"
#include "surface/cli/bundle_folder.h"
#include "surface/cli/certificate_run.h"
#include "surface/cli/commands.h"
#include "surface/cli/terminal.h"

#include <fmt/format.h>

#include <memory>
#include <string>

namespace feedhold {

namespace {

struct RecheckArguments {
  std::string folder;
  std::string against;
  unsigned jobs = 0;
  bool quiet = false;
};

ProofsWish wishFrom(const BundleOrigin &origin, const RecheckArguments &arguments) {
  ProofsWish wish;
  for (const std::filesystem::path &path : origin.paths)
    wish.files.paths.push_back(path.generic_string());
  wish.files.dialect = origin.reading.dialect;
  if (origin.reading.isolated)
    wish.files.config.source = ConfigSource::None;
  else if (origin.reading.config)
    wish.files.config = {ConfigSource::Named, *origin.reading.config};
  wish.files.jobs = arguments.jobs;
  wish.prove.only = origin.reading.only;
  keepEvidence(wish);
  return wish;
}

std::optional<std::string> complaintAbout(const BundleOrigin &origin) {
  if (origin.paths.empty())
    return "nothing is proved in it";
  return origin.reading.dialect ? complaintAboutDialect(*origin.reading.dialect, allDialects()) : std::nullopt;
}

std::string counted(std::size_t count, std::string_view thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

int present(const BundleCheck &check, std::size_t obligations, const RecheckArguments &arguments) {
  for (const std::string &problem : check.problems)
    print(problem + "\n");
  if (!arguments.quiet)
    print(fmt::format("{}: {} proved again, {} followed, {} solved again\n",
                      check.problems.empty() ? "all as it was" : counted(check.problems.size(), "difference"),
                      counted(obligations, "obligation"), counted(check.certificates, "certificate"),
                      counted(check.solved, "text")));
  return check.problems.empty() ? kExitClean : kExitFindings;
}

void addVersion(BundleCheck &check, const std::string &version) {
  if (version != FEEDHOLD_VERSION)
    check.problems.push_back(
        fmt::format("it was made by feedhold {}, and this is feedhold {}", version, FEEDHOLD_VERSION));
}

Result<int> recheckBundle(const Bundle &stored, const RecheckArguments &arguments) {
  const Result<BundleOrigin> origin = originOf(stored, arguments.folder);
  if (!origin)
    return origin.error();
  if (const auto complaint = complaintAbout(origin.value()))
    return Error{*complaint};

  BundleCheck check = checkEvidence(stored);
  addVersion(check, origin.value().version);
  const ProofsResult result = proveAll(wishFrom(origin.value(), arguments), {allDialects(), allRules()});
  for (const PathProblem &problem : result.errors)
    check.problems.push_back(problem.path + ": " + problem.message);
  const Bundle now = makeBundle(result, origin.value().reading, FEEDHOLD_VERSION, arguments.folder);
  for (std::string &difference : differences(stored, now))
    check.problems.push_back(std::move(difference));
  std::size_t obligations = 0;
  for (const ProvedFile &file : result.files)
    for (const ProvedProgram &program : file.programs)
      obligations += program.proof.obligations.size();
  return present(check, obligations, arguments);
}

// ---- the report of `certify` ----

std::string sayEvidence(const BundleCheck &check) {
  return fmt::format("{} followed by the checker, {} asked again (Z3 refutes {}, cvc5 refutes {})",
                     counted(check.certificates, "certificate"), counted(check.solved, "question"), check.byZ3,
                     check.byCvc5);
}

int presentReport(const BundleCheck &check, const std::string &told, const RecheckArguments &arguments, int whenSame) {
  for (const std::string &problem : check.problems)
    print(problem + "\n");
  if (!arguments.quiet)
    print(fmt::format("{}: {}; {}\n",
                      check.problems.empty() ? "all as it was" : counted(check.problems.size(), "difference"), told,
                      sayEvidence(check)));
  return check.problems.empty() ? whenSame : kExitFindings;
}

/// Programs that lie elsewhere are compared, and not proved again: what they call may be anywhere.
Result<int> recheckReport(const Bundle &stored, const RecheckArguments &arguments) {
  const Result<CertificateOrigin> origin = certificateOrigin(stored, arguments.folder);
  if (!origin)
    return origin.error();
  if (const auto &dialect = origin.value().wish.reading.dialect)
    if (const auto complaint = complaintAboutDialect(*dialect, allDialects()))
      return Error{*complaint};
  BundleCheck check = checkEvidence(evidenceOf(stored));
  for (std::string &problem : check.problems)
    problem.insert(1, kEvidenceFolder);
  addVersion(check, origin.value().version);
  const auto add = [&](std::vector<std::string> lines) {
    check.problems.insert(check.problems.end(), lines.begin(), lines.end());
  };
  add(inconsistencies(stored));
  const auto place = arguments.against.empty() ? std::nullopt : std::optional<std::filesystem::path>(arguments.against);
  const SourceCheck sources = checkSources(stored, arguments.folder, place);
  add(sources.changed);
  const std::string compared = counted(sources.same, "source") + " as named";
  if (place || (sources.same == 0 && sources.changed.empty())) {
    for (const std::string &gone : sources.gone)
      printAside(fmt::format("`{}` is not there: it is not compared\n", gone));
    return presentReport(check, compared + ", nothing proved again", arguments, kExitUnknown);
  }
  for (const std::string &gone : sources.gone)
    check.problems.push_back(fmt::format("`{}` was read for the proof and is gone", gone));
  const CertificateRun run = runCertificate(origin.value().wish, arguments.folder, arguments.jobs);
  for (const PathProblem &problem : run.problems)
    check.problems.push_back(problem.path + ": " + problem.message);
  if (run.problems.empty()) {
    add(differences(evidenceOf(stored), evidenceOf(run.report)));
    add(certificateDifferences(stored, run.report));
  }
  return presentReport(check, fmt::format("{}, {} proved again", compared, counted(run.counts.all(), "obligation")),
                       arguments, kExitClean);
}

Result<int> recheck(const RecheckArguments &arguments) {
  const Result<Bundle> stored = readBundle(arguments.folder);
  if (!stored)
    return stored.error();
  if (stored.value().contains(std::string(kCertificate)))
    return recheckReport(stored.value(), arguments);
  if (!arguments.against.empty())
    return Error{"--against is for reports of `feedhold certify`"};
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
      parent.add_subcommand("recheck", "prove again what `certify` or `prove --certificate` has written, and compare");
  const auto arguments = std::make_shared<RecheckArguments>();
  app->add_option("folder", arguments->folder, "what was named to `certify -o` or `prove --certificate`")->required();
  app->add_option("--against", arguments->against,
                  "of a report: compare the programs of this folder, where those that were proved are not at hand");
  app->add_option("--jobs", arguments->jobs, "number of threads (default: one per processor)");
  app->add_flag("-q,--quiet", arguments->quiet, "print differences only");
  return {app, [arguments] { return recheckOrComplain(*arguments); }};
}

} // namespace feedhold
