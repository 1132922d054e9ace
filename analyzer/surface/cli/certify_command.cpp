// `feedhold certify [PATHS] -o FOLDER`: a report of proofs for people who release programs.
#include "base/source/path_text.h"
#include "dialects/registry.h"
#include "rules/registry.h"
#include "surface/cli/bundle_folder.h"
#include "surface/cli/commands.h"
#include "surface/cli/kind_options.h"
#include "surface/cli/report_run.h"
#include "surface/cli/shard_options.h"
#include "surface/cli/shared_options.h"
#include "surface/cli/terminal.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <memory>

namespace feedhold {

namespace {

struct CertifyArguments {
  std::vector<std::string> paths;
  std::vector<std::string> only;
  std::string output;
  ControlArguments control;
  ConfigArguments config;
  std::string date;
  unsigned jobs = 0;
  bool quiet = false;
  ShardOptions shard;
};

void addOptions(CLI::App &app, CertifyArguments &arguments) {
  app.add_option("paths", arguments.paths, "files and folders (default: current folder)")->type_name("PATH");
  app.add_option("-o,--output", arguments.output, "folder of the report; an existing report there is replaced")
      ->type_name("FOLDER");
  addOnlyKinds(app, arguments.only);
  addControl(app, arguments.control);
  addConfiguration(app, arguments.config);
  app.add_option("--date", arguments.date, "date printed on the report (default: from SOURCE_DATE_EPOCH, else none)")
      ->type_name("TEXT");
  addJobs(app, arguments.jobs);
  addQuiet(app, arguments.quiet, "print no summary");
  addShardOptions(app, arguments.shard);
}

int exitCodeOf(ReleaseStatus status) {
  switch (status) {
  case ReleaseStatus::Ready: return kExitClean;
  case ReleaseStatus::Open: return kExitUnknown;
  case ReleaseStatus::Alarms:
  case ReleaseStatus::Broken: return kExitFindings;
  }
  return kExitCouldNotRun;
}

/// A shard writes its part, every other run a report.
std::optional<std::string> complaintAboutOutput(const CertifyArguments &arguments) {
  const bool isShard = !arguments.shard.shard.empty();
  if (const auto complaint = complaintAbout(arguments.shard, isShard && !arguments.output.empty() ? "--output" : ""))
    return complaint;
  if (isShard == arguments.shard.part.empty())
    return "a shard of a report needs both --shard and --part; `feedhold merge` writes the report";
  if (arguments.output.empty() && !isShard)
    return "--output is required: the folder of the report";
  return std::nullopt;
}

/// The files of the shard, and what it keeps or is given.
Result<ReportPart> partOf(const CertifyArguments &arguments, const ReportOptions &options, Answers &kept) {
  Result<std::optional<std::set<std::string>>> files =
      filesOf(arguments.shard, filesOfReport(options, arguments.jobs), {allDialects(), allRules()});
  if (!files)
    return files.error();
  ReportPart part{.files = files.take(), .answers = {.given = arguments.shard.given}};
  if (!arguments.shard.part.empty())
    part.answers.kept = &kept;
  return part;
}

Result<int> finishShard(const CertifyArguments &arguments, const CLI::App &command, const ReportRun &run,
                        const Answers &kept) {
  if (const auto error = writePartOf(arguments.shard, command, kept, run.costs))
    return *error;
  if (!arguments.quiet)
    print(fmt::format("{} in {} program{}: {}\n", textOf(run.counts), run.programs, run.programs == 1 ? "" : "s",
                      arguments.shard.part));
  return exitCodeOf(run.status);
}

/// The part of a shard tells the merge what was proved beside what cannot be read, so that the merge complains as one
/// run.
Error refuseReport(const CertifyArguments &arguments, const CLI::App &command, const ReportRun &run,
                   const Answers &kept) {
  for (const PathProblem &problem : run.problems)
    printError(problem.path + ": " + problem.message);
  if (run.isProved)
    if (auto error = writePartOf(arguments.shard, command, kept, run.costs))
      return *std::move(error);
  return Error{"no report was written, since it would not cover all of the named files"};
}

/// The reproducible-builds.org convention: seconds since 1970, in UTC.
Result<std::optional<std::string>> dateOf(const CertifyArguments &arguments) {
  if (!arguments.date.empty())
    return std::optional(arguments.date);
  const char *epoch = std::getenv("SOURCE_DATE_EPOCH");
  if (epoch == nullptr || *epoch == '\0')
    return std::optional<std::string>();
  const std::string_view text = epoch;
  std::uint32_t seconds = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  if (error != std::errc() || end != text.data() + text.size())
    return Error{fmt::format("SOURCE_DATE_EPOCH is `{}`, which is not a number of seconds", text)};
  return std::optional(fmt::format("{:%Y-%m-%d}", fmt::gmtime(static_cast<std::time_t>(seconds))));
}

/// One spelling for each file: `nc/` and `.` within it are `nc`.
std::filesystem::path plainPath(const std::string &path) {
  const std::filesystem::path absolute = normalPath(absolutePath(path));
  return absolute.has_filename() ? absolute : absolute.parent_path();
}

Result<ReportOptions> optionsOf(const CertifyArguments &arguments) {
  ReportOptions options;
  for (const std::string &path : arguments.paths) {
    if (path == "-")
      return Error{"certify needs named files: standard input cannot be read again"};
    options.paths.push_back(plainPath(path));
  }
  if (options.paths.empty())
    options.paths = {plainPath(".")};
  if (const auto complaint = complaintAbout(arguments.control))
    return Error{*complaint};
  options.reading.control = controlFrom(arguments.control);
  options.reading.isolated = arguments.config.isolated;
  if (!arguments.config.file.empty())
    options.reading.config = arguments.config.file;
  options.reading.only = kindsFrom(arguments.only);
  const auto date = dateOf(arguments);
  if (!date)
    return date.error();
  options.date = date.value();
  return options;
}

Result<int> certify(const CertifyArguments &arguments, const CLI::App &command) {
  if (const auto complaint = complaintAboutOutput(arguments))
    return Error{*complaint};
  const Result<ReportOptions> options = optionsOf(arguments);
  if (!options)
    return options.error();
  Answers kept;
  const Result<ReportPart> part = partOf(arguments, options.value(), kept);
  if (!part)
    return part.error();
  if (const auto refusal = whyNoBundleFits(arguments.output, kReportDocument))
    return Error{arguments.output + ": " + refusal->message};
  const ReportRun run = runReport(options.value(), arguments.output, arguments.jobs, part.value());
  if (!run.problems.empty())
    return refuseReport(arguments, command, run, kept);
  if (!arguments.shard.shard.empty())
    return finishShard(arguments, command, run, kept);
  if (const auto error = writeBundle(arguments.output, run.report))
    return Error{arguments.output + ": " + error->message};
  if (!arguments.quiet)
    print(fmt::format("{} in {} program{}: {}\n", textOf(run.counts), run.programs, run.programs == 1 ? "" : "s",
                      pathText((std::filesystem::path(arguments.output) / kReportPage))));
  return exitCodeOf(run.status);
}

int certifyOrComplain(const CertifyArguments &arguments, const CLI::App &command) {
  const Result<int> exitCode = certify(arguments, command);
  if (exitCode)
    return exitCode.value();
  printError(exitCode.error().message);
  return kExitCouldNotRun;
}

} // namespace

Command addCertifyCommand(CLI::App &parent, const Answers *given) {
  CLI::App *app = parent.add_subcommand("certify", "write a release report of all proofs, to be signed");
  const auto arguments = std::make_shared<CertifyArguments>();
  addOptions(*app, *arguments);
  arguments->shard.given = given;
  return {app, [app, arguments] { return certifyOrComplain(*arguments, *app); }};
}

} // namespace feedhold
