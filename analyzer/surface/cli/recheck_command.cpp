// `feedhold recheck DIR`: whether a bundle of proofs still says what proving the same now says, and whether its
// evidence holds.
#include "dialects/registry.h"
#include "rules/registry.h"
#include "surface/cli/bundle_folder.h"
#include "surface/cli/commands.h"
#include "surface/cli/terminal.h"

#include <fmt/format.h>

#include <memory>
#include <string>

namespace feedhold {

namespace {

struct RecheckArguments {
  std::string folder;
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

Result<int> recheck(const RecheckArguments &arguments) {
  const Result<Bundle> stored = readBundle(arguments.folder);
  if (!stored)
    return stored.error();
  const Result<BundleOrigin> origin = originOf(stored.value(), arguments.folder);
  if (!origin)
    return origin.error();
  if (const auto complaint = complaintAbout(origin.value()))
    return Error{*complaint};

  BundleCheck check = checkEvidence(stored.value());
  if (origin.value().version != FEEDHOLD_VERSION)
    check.problems.push_back(
        fmt::format("it was made by feedhold {}, and this is feedhold {}", origin.value().version, FEEDHOLD_VERSION));
  const ProofsResult result = proveAll(wishFrom(origin.value(), arguments), {allDialects(), allRules()});
  for (const PathProblem &problem : result.errors)
    check.problems.push_back(problem.path + ": " + problem.message);
  const Bundle now = makeBundle(result, origin.value().reading, FEEDHOLD_VERSION, arguments.folder);
  for (std::string &difference : differences(stored.value(), now))
    check.problems.push_back(std::move(difference));
  std::size_t obligations = 0;
  for (const ProvedFile &file : result.files)
    for (const ProvedProgram &program : file.programs)
      obligations += program.proof.obligations.size();
  return present(check, obligations, arguments);
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
  CLI::App *app = parent.add_subcommand("recheck", "prove again what `prove --certificate` has written, and compare");
  const auto arguments = std::make_shared<RecheckArguments>();
  app->add_option("folder", arguments->folder, "what was named to --certificate")->required();
  app->add_option("--jobs", arguments->jobs, "number of threads (default: one per processor)");
  app->add_flag("-q,--quiet", arguments->quiet, "print differences only");
  return {app, [arguments] { return recheckOrComplain(*arguments); }};
}

} // namespace feedhold
