// `feedhold prove [PATHS]`: verdicts on the obligations of programs, for every input that their contracts allow.
#include "dialects/registry.h"
#include "findings/project/discovery.h"
#include "rules/registry.h"
#include "surface/cli/baseline_file.h"
#include "surface/cli/bundle_folder.h"
#include "surface/cli/cache_place.h"
#include "surface/cli/change_options.h"
#include "surface/cli/commands.h"
#include "surface/cli/kind_options.h"
#include "surface/cli/shard_options.h"
#include "surface/cli/shared_options.h"
#include "surface/cli/terminal.h"
#include "surface/sink/prove_sink.h"
#include "surface/sink/sink.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

namespace feedhold {

namespace fs = std::filesystem;

namespace {

struct ProveArguments {
  std::vector<std::string> paths;
  std::vector<std::string> only;
  ControlArguments control;
  ConfigArguments config;
  std::string arithmetic = "control";
  std::string missing = "return";
  unsigned effort = 1;
  std::string certificate;
  CacheArguments cache;
  std::string format = "text";
  std::string color = "auto";
  std::string stdinFilename = "<stdin>";
  unsigned jobs = 0;
  bool verbose = false;
  bool quiet = false;
  bool statistics = false;
  BaselineOptions baseline;
  ChangeOptions change;
  ShardOptions shard;
};

void addOptions(CLI::App &app, ProveArguments &arguments) {
  app.add_option("paths", arguments.paths, "files and folders; - is standard input (default: current folder)")
      ->type_name("PATH");
  addOnlyKinds(app, arguments.only);
  addControl(app, arguments.control);
  addConfiguration(app, arguments.config);
  CLI::Option *certificate = app.add_option("--certificate", arguments.certificate,
                                            "write the evidence of all proofs to this folder, for `feedhold recheck`")
                                 ->type_name("FOLDER");
  app.add_option("--arithmetic", arguments.arithmetic,
                 "prove in the rounded numbers of the control, or in exact numbers as on paper (faster)")
      ->check(CLI::IsMember({"control", "exact"}))
      ->capture_default_str()
      ->excludes(certificate);
  app.add_option(
         "--missing", arguments.missing,
         "what a call of a program that is in none of the files does: the program returns and may change common "
         "variables, modal codes and the position; the control stops; or anything (havoc)")
      ->check(CLI::IsMember({"return", "stop", "havoc"}))
      ->capture_default_str()
      ->excludes(certificate);
  app.add_option("--effort", arguments.effort, "multiply the step budget of each program: more proofs, in more time")
      ->check(CLI::Range(1U, 100U))
      ->capture_default_str()
      ->excludes(certificate);
  addFormat(app, arguments.format, {"text", "json", "sarif"});
  addCache(app, arguments.cache);
  addJobs(app, arguments.jobs);
  addColor(app, arguments.color);
  addStdinFilename(app, arguments.stdinFilename);
  app.add_flag("-v,--verbose", arguments.verbose, "print how each proof was found and what it cost");
  addQuiet(app, arguments.quiet);
  app.add_flag("--statistics", arguments.statistics, "print the number of verdicts per kind instead of the verdicts");
  addBaselineOptions(app, arguments.baseline);
  addChangedSince(app, arguments.change);
  addWithCallers(app, arguments.change);
  addShardOptions(app, arguments.shard);
}

/// The evidence is not in the cache.
Result<std::optional<ProofCache>> cacheFor(const ProveArguments &arguments) {
  if (arguments.cache.off || !arguments.certificate.empty() || arguments.shard.given != nullptr)
    return std::optional<ProofCache>();
  return proofCache(arguments.cache.folder.empty() ? std::nullopt : std::optional<fs::path>(arguments.cache.folder),
                    arguments.cache.url);
}

ProofOptions proofOptionsOf(const ProveArguments &arguments) {
  ProofOptions options;
  options.files.paths = arguments.paths;
  if (std::erase(options.files.paths, "-") != 0)
    options.files.piped = PipedText{arguments.stdinFilename, readStandardInput()};
  else if (options.files.paths.empty())
    options.files.paths = {"."};
  options.files.control = controlFrom(arguments.control);
  options.files.config = configFrom(arguments.config);
  options.files.jobs = arguments.jobs;
  options.prove.only = kindsFrom(arguments.only);
  if (arguments.arithmetic == "exact")
    options.prove.arithmetic = prove::Arithmetic::Exact;
  options.prove.steps *= arguments.effort;
  options.prove.missing = arguments.missing == "stop"    ? MissingPrograms::Stop
                          : arguments.missing == "havoc" ? MissingPrograms::DoAnything
                                                         : MissingPrograms::Return;
  if (!arguments.certificate.empty())
    keepEvidence(options);
  return options;
}

BundleReading bundleReading(const ProveArguments &arguments) {
  BundleReading reading{.control = controlFrom(arguments.control), .only = kindsFrom(arguments.only)};
  reading.isolated = arguments.config.isolated;
  if (!arguments.config.file.empty())
    reading.config = arguments.config.file;
  return reading;
}

bool hasContradiction(const ProofsResult &result) {
  return std::any_of(result.files.begin(), result.files.end(), [](const ProvedFile &file) {
    return std::any_of(file.programs.begin(), file.programs.end(),
                       [](const ProvedProgram &program) { return !program.proof.contradictions.empty(); });
  });
}

int exitCodeOf(const ProofsResult &result) {
  if (hasContradiction(result))
    return kExitDefect;
  if (!result.errors.empty())
    return kExitCouldNotRun;
  bool isRefuted = false;
  bool isUnknown = false;
  for (const ProvedFile &file : result.files)
    for (const ProvedProgram &program : file.programs)
      for (const prove::Obligation &obligation : program.proof.obligations) {
        isRefuted = isRefuted || obligation.verdict == prove::Verdict::Refuted;
        isUnknown = isUnknown || obligation.verdict == prove::Verdict::Unknown;
      }
  return isRefuted ? kExitFindings : isUnknown ? kExitUnknown : kExitClean;
}

/// Being asked to prove something and finding no program is a mistake in the call.
void complainIfNothingWasProved(ProofsResult &result, const ProveArguments &arguments) {
  if (!result.files.empty() || !result.errors.empty())
    return;
  const auto mistake = std::find_if(result.skipped.begin(), result.skipped.end(), [&](const SkippedFile &skipped) {
    return !isNamedByChance(skipped, arguments.paths);
  });
  if (mistake != result.skipped.end())
    result.errors.push_back({mistake->path, "nothing to prove: " + mistake->reason});
}

/// An option that changes what a run does so that it cannot be a part of another.
std::string apartFromShards(const ProveArguments &arguments) {
  if (std::find(arguments.paths.begin(), arguments.paths.end(), "-") != arguments.paths.end())
    return "standard input";
  return !arguments.certificate.empty()                                  ? "--certificate"
         : arguments.baseline.update && arguments.shard.given == nullptr ? "--update-baseline"
         : arguments.change.isAsked()                                    ? "--changed-since or --with-callers"
                                                                         : "";
}

std::optional<std::string> complaintAbout(const ProveArguments &arguments) {
  if (auto complaint = complaintAbout(arguments.control))
    return complaint;
  if (auto complaint = complaintAbout(arguments.shard, apartFromShards(arguments)))
    return complaint;
  if (arguments.certificate.empty())
    return std::nullopt;
  if (std::find(arguments.paths.begin(), arguments.paths.end(), "-") != arguments.paths.end())
    return "--certificate needs named files: standard input cannot be read again";
  if (const auto refusal = whyNoBundleFits(arguments.certificate, kBundleIndex))
    return arguments.certificate + ": " + refusal->message;
  return std::nullopt;
}

/// Prints the verdicts; returns the exit code.
int present(const ProofsResult &result, const ProveArguments &arguments) {
  const ProveReport report{.result = result,
                           .version = FEEDHOLD_VERSION,
                           .root = std::filesystem::current_path(),
                           .exitCode = exitCodeOf(result),
                           .readingOptions = readingOptions(bundleReading(arguments)),
                           .arithmetic = arguments.certificate.empty() ? arguments.arithmetic : "exact",
                           .showMethods = arguments.verbose ? ShowMethods::Yes : ShowMethods::No,
                           .colour = useColour(colourOptionFrom(arguments.color))};
  printProblems(result.errors);
  printAside(defectsText(report));
  print(arguments.statistics          ? proveStatistics(report)
        : arguments.format == "json"  ? writeProveJson(report)
        : arguments.format == "sarif" ? writeProveSarif(report)
                                      : writeProveText(report));
  if (!arguments.quiet)
    printAside(skippedFiles(result.skipped));
  if (!arguments.quiet && arguments.format == "text")
    print(proveSummary(report));
  return report.exitCode;
}

/// Leaves what a change concerns; the result is what is wrong with the files among which was searched.
Result<std::vector<PathProblem>> narrow(ProofOptions &options, const ProveArguments &arguments) {
  if (!arguments.change.isAsked()) {
    Result<std::optional<std::set<std::string>>> files =
        filesOf(arguments.shard, options.files, {allDialects(), allRules()});
    if (!files)
      return files.error();
    options.files.only = files.take();
    return std::vector<PathProblem>();
  }
  if (auto complaint = complaintAbout(arguments.change, options.files))
    return Error{std::move(*complaint)};
  Result<Affected> found = affected(arguments.change, options.files, {allDialects(), allRules()});
  if (!found)
    return found.error();
  const Affected affected = found.take();
  options.files.paths.assign(affected.programs.begin(), affected.programs.end());
  return affected.errors;
}

void addErrors(ProofsResult &result, const std::vector<PathProblem> &errors) {
  for (const PathProblem &error : errors)
    if (std::none_of(result.errors.begin(), result.errors.end(), [&](const PathProblem &known) {
          return known.path == error.path && known.message == error.message;
        }))
      result.errors.push_back(error);
}

int runProve(const ProveArguments &arguments, const CLI::App &command) {
  const std::optional<Baseline> baseline = baselineToStart(complaintAbout(arguments), arguments.baseline);
  if (!baseline)
    return kExitCouldNotRun;
  ProofOptions options = proofOptionsOf(arguments);
  Result<std::optional<ProofCache>> cache = cacheFor(arguments);
  const Result<std::vector<PathProblem>> narrowed =
      cache ? narrow(options, arguments) : Result<std::vector<PathProblem>>(cache.error());
  if (!narrowed) {
    printError(narrowed.error().message);
    return kExitCouldNotRun;
  }
  options.cache = cache.take();
  Answers kept;
  options.answers = {.kept = arguments.shard.part.empty() ? nullptr : &kept, .given = arguments.shard.given};
  ProofsResult result = proveAll(options, {allDialects(), allRules()});
  addErrors(result, narrowed.value());
  if (options.cache && options.cache->shared)
    for (const std::string &problem : options.cache->shared->problems())
      printAside(fmt::format("feedhold: {}\n", problem));
  if (arguments.shard.shard.empty())
    complainIfNothingWasProved(result, arguments);
  if (const auto error = writePartOf(arguments.shard, command, kept, costsOf(result))) {
    printError(error->message);
    return kExitCouldNotRun;
  }
  if (!arguments.certificate.empty())
    if (const auto error = writeBundle(arguments.certificate, makeBundle(result, bundleReading(arguments),
                                                                         FEEDHOLD_VERSION, arguments.certificate)))
      result.errors.push_back({arguments.certificate, error->message});
  const BaselineScope scope{.folder = arguments.baseline.isAsked() ? folderOf(arguments.baseline) : fs::path(),
                            .kinds = options.prove.only};
  if (arguments.baseline.update)
    return updateBaselineFile(*baseline, updated(*baseline, result, scope), arguments.baseline, result.errors,
                              arguments.quiet ? UpdateTold::No : UpdateTold::Yes);
  if (!arguments.baseline.isAsked())
    return present(result, arguments);
  const NewVerdicts found = withoutKnown(std::move(result), *baseline, scope);
  const int exitCode = present(found.result, arguments);
  if (!arguments.quiet)
    printAside(told(found, arguments.baseline));
  return exitCode;
}

} // namespace

Command addProveCommand(CLI::App &parent, const Answers *given) {
  CLI::App *app =
      parent.add_subcommand("prove", "prove contracts, and that programs end and raise no alarm, for all inputs");
  app->footer("Exit codes: 0 all proved, 1 something is refuted, 2 the command could not run, 3 something is unknown.\n"
              "Example: feedhold prove O9100.nc");
  const auto arguments = std::make_shared<ProveArguments>();
  addOptions(*app, *arguments);
  arguments->shard.given = given;
  return {app, [app, arguments] { return runProve(*arguments, *app); }};
}

} // namespace feedhold
