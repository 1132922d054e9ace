// `feedhold check`: analyses programs and prints what it finds.
#include "base/diag/edits.h"
#include "base/source/write_file.h"
#include "dialects/registry.h"
#include "findings/project/discovery.h"
#include "findings/project/selection.h"
#include "findings/project/watched.h"
#include "findings/session/session.h"
#include "rules/registry.h"
#include "surface/cli/baseline_file.h"
#include "surface/cli/change_options.h"
#include "surface/cli/commands.h"
#include "surface/cli/shard_options.h"
#include "surface/cli/shared_options.h"
#include "surface/cli/terminal.h"
#include "surface/sink/sink.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

namespace feedhold {

namespace {

/// The options as they are written.
struct CheckArguments {
  std::vector<std::string> paths;
  ControlArguments control;
  std::string format = "text";
  std::string output;
  std::vector<std::string> select;
  std::vector<std::string> ignore;
  std::string errorOn;
  std::string minSeverity;
  ConfigArguments config;
  std::string stdinFilename = "<stdin>";
  std::string color = "auto";
  unsigned jobs = 0;
  bool fix = false;
  bool unsafeFixes = false;
  bool diff = false;
  bool showSuppressed = false;
  bool quiet = false;
  bool statistics = false;
  bool exitZero = false;
  bool watch = false;
  BaselineOptions baseline;
  ChangeOptions change;
  ShardOptions shard;
};

void addOptions(CLI::App &app, CheckArguments &arguments) {
  app.add_option("paths", arguments.paths, "files and folders; - is standard input (default: current folder)")
      ->type_name("PATH");
  addControl(app, arguments.control);
  addFormat(app, arguments.format, {"text", "concise", "json", "sarif", "junit", "github"});
  app.add_option("--output", arguments.output, "write the findings to this file")->type_name("FILE");
  app.add_option("--select", arguments.select, "check only these rules or categories (comma-separated, or repeated)")
      ->type_name("RULE")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--ignore", arguments.ignore, "skip these rules or categories (comma-separated, or repeated)")
      ->type_name("RULE")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--error-on", arguments.errorOn, "lowest severity that gives exit code 1 (default: warning)")
      ->type_name("SEVERITY")
      ->check(CLI::IsMember({"error", "warning", "info"}));
  app.add_option("--severity", arguments.minSeverity,
                 "lowest severity that is reported (default: warning; with --select: info)")
      ->type_name("SEVERITY")
      ->check(CLI::IsMember({"error", "warning", "info"}));
  addConfiguration(app, arguments.config);
  app.add_flag("--fix", arguments.fix, "apply safe fixes to the files");
  app.add_flag("--unsafe-fixes", arguments.unsafeFixes, "with --fix or --diff: include fixes that need your review");
  app.add_flag("--diff", arguments.diff, "print the fixes as a unified diff and change no file");
  addJobs(app, arguments.jobs);
  addColor(app, arguments.color);
  addStdinFilename(app, arguments.stdinFilename);
  app.add_flag("--show-suppressed", arguments.showSuppressed, "also print findings that @ALLOW suppresses");
  addQuiet(app, arguments.quiet);
  app.add_flag("--statistics", arguments.statistics, "print the number of findings per rule instead of the findings");
  app.add_flag("--exit-zero", arguments.exitZero, "exit with 0 even if there are findings");
  app.add_flag("--watch", arguments.watch, "check again whenever a file changes; stop with Ctrl-C");
  addBaselineOptions(app, arguments.baseline);
  addChangedSince(app, arguments.change);
  addShardOptions(app, arguments.shard);
}

/// An option that changes what a run does so that it cannot be a part of another.
std::string apartFromShards(const CheckArguments &arguments) {
  if (std::find(arguments.paths.begin(), arguments.paths.end(), "-") != arguments.paths.end())
    return "standard input";
  return arguments.fix                                                   ? "--fix"
         : arguments.diff                                                ? "--diff"
         : arguments.watch                                               ? "--watch"
         : arguments.baseline.update && arguments.shard.given == nullptr ? "--update-baseline"
         : arguments.change.isAsked()                                    ? "--changed-since"
                                                                         : "";
}

const KnownNames &knownNames() {
  static const KnownNames known{allDialects(), allRules()};
  return known;
}

/// What is wrong with the options beyond their form.
std::optional<std::string> complaintAbout(const CheckArguments &arguments) {
  for (const std::vector<std::string> *names : {&arguments.select, &arguments.ignore})
    for (const std::string &name : *names)
      if (auto complaint = complaintAboutRuleName(name, allRules()))
        return complaint;
  if (auto complaint = complaintAbout(arguments.control))
    return complaint;
  if (auto complaint = complaintAbout(arguments.shard, apartFromShards(arguments)))
    return complaint;
  const bool isPiped = std::find(arguments.paths.begin(), arguments.paths.end(), "-") != arguments.paths.end();
  if (isPiped && arguments.fix && !arguments.diff)
    return "--fix cannot change standard input; use --diff to see the fixes";
  if (arguments.baseline.isAsked() && (arguments.fix || arguments.diff))
    return "--baseline cannot be combined with --fix or --diff, which fix all findings";
  if (arguments.watch && (isPiped || arguments.fix || arguments.diff || arguments.baseline.update))
    return "--watch cannot be combined with standard input, --fix, --diff or --update-baseline";
  if (arguments.unsafeFixes && !arguments.fix && !arguments.diff)
    return "--unsafe-fixes needs --fix to apply the fixes, or --diff to print them";
  return std::nullopt;
}

CheckOptions toOptions(const CheckArguments &arguments) {
  CheckOptions options;
  options.paths = arguments.paths;
  if (std::erase(options.paths, "-") != 0)
    options.piped = PipedText{arguments.stdinFilename, readStandardInput()};
  else if (options.paths.empty())
    options.paths = {"."};
  options.control = controlFrom(arguments.control);
  options.select = arguments.select;
  options.ignore = arguments.ignore;
  options.errorOn = severityFromName(arguments.errorOn);
  options.minSeverity = severityFromName(arguments.minSeverity);
  options.config = configFrom(arguments.config);
  options.jobs = arguments.jobs;
  return options;
}

int exitCodeOf(const CheckResult &result, const CheckArguments &arguments) {
  if (!result.errors.empty())
    return kExitCouldNotRun;
  return anyFails(result) && !arguments.exitZero ? kExitFindings : kExitClean;
}

/// Being asked to check something and checking nothing is a mistake in the call, not a clean program.
void complainIfNothingWasChecked(CheckResult &result, const CheckArguments &arguments) {
  if (!result.files.empty() || !result.errors.empty())
    return;
  const auto mistake = std::find_if(result.skipped.begin(), result.skipped.end(), [&](const SkippedFile &skipped) {
    return !isNamedByChance(skipped, arguments.paths);
  });
  if (mistake != result.skipped.end())
    result.errors.push_back({mistake->path, "nothing to check: " + mistake->reason});
}

/// The rules that the options leave; which of them a configuration turns off makes their old findings gone.
BaselineScope scopeOf(const CheckArguments &arguments, const std::vector<const Rule *> &rules) {
  return {.folder = folderOf(arguments.baseline), .rules = rules};
}

std::vector<const Rule *> rulesOf(const CheckArguments &arguments) {
  return selectRules(
      allRules(), {{SelectionStep::Kind::Select, arguments.select}, {SelectionStep::Kind::Ignore, arguments.ignore}});
}

/// Prints the findings; returns the exit code.
int present(const CheckResult &result, const CheckArguments &arguments) {
  const Format format = *formatFromName(arguments.format);
  // The log of a workflow is for people, too; annotations are few.
  const bool isForPeople = format == Format::Text || format == Format::Concise || format == Format::Github;
  int exitCode = exitCodeOf(result, arguments);
  const Report report{.result = result,
                      .rules = allRules(),
                      .version = FEEDHOLD_VERSION,
                      .root = std::filesystem::current_path(),
                      .exitCode = exitCode,
                      .showSuppressed = arguments.showSuppressed ? ShowSuppressed::Yes : ShowSuppressed::No,
                      .colour = arguments.output.empty() && useColour(colourOptionFrom(arguments.color))};
  const std::string text = arguments.statistics ? statistics(report) : write(format, report);
  printProblems(result.errors);
  if (arguments.output.empty()) {
    print(text);
  } else if (const auto error = writeFile(arguments.output, text)) {
    printError(arguments.output + ": " + error->message);
    exitCode = kExitCouldNotRun;
  }
  if (arguments.quiet)
    return exitCode;
  printAside(skippedFiles(result.skipped));
  if (isForPeople || !arguments.output.empty())
    print(summary(report));
  return exitCode;
}

int showDiffs(const FixResult &fixed, const CheckArguments &arguments) {
  std::string text;
  for (const FixedFile &file : fixed.files)
    text += unifiedDiff(file.path, file.before, file.after);
  print(text);
  printProblems(fixed.remaining.errors);
  if (!fixed.remaining.errors.empty())
    return kExitCouldNotRun;
  return fixed.files.empty() || arguments.exitZero ? kExitClean : kExitFindings;
}

int repair(const CheckOptions &options, const CheckArguments &arguments, ProgressLine &progress) {
  FixResult fixed = fix(options, arguments.unsafeFixes ? FixKind::All : FixKind::Safe, knownNames());
  progress.clear();
  complainIfNothingWasChecked(fixed.remaining, arguments);
  if (arguments.diff)
    return showDiffs(fixed, arguments);
  const std::vector<PathProblem> unwritten = writeFixes(fixed.files);
  fixed.remaining.errors.insert(fixed.remaining.errors.end(), unwritten.begin(), unwritten.end());
  std::size_t repairs = 0;
  for (const FixedFile &file : fixed.files)
    repairs += file.fixes;
  if (repairs != 0 && !arguments.quiet)
    printAside(fmt::format("applied {} fix{} in {} file{}\n", repairs, repairs == 1 ? "" : "es", fixed.files.size(),
                           fixed.files.size() == 1 ? "" : "s"));
  return present(fixed.remaining, arguments);
}

int updateBaseline(const CheckResult &result, const Baseline &before, const CheckArguments &arguments) {
  const std::vector<const Rule *> rules = rulesOf(arguments);
  return updateBaselineFile(before, updated(before, result, scopeOf(arguments, rules)), arguments.baseline,
                            result.errors, arguments.quiet ? UpdateTold::No : UpdateTold::Yes);
}

int presentNew(CheckResult result, const Baseline &baseline, const CheckArguments &arguments) {
  const std::vector<const Rule *> rules = rulesOf(arguments);
  const NewFindings found = withoutKnown(std::move(result), baseline, scopeOf(arguments, rules));
  const int exitCode = present(found.result, arguments);
  if (!arguments.quiet)
    printAside(told(found, arguments.baseline));
  return exitCode;
}

/// The files on which rules run; absent: all.  Errors among the files come again when they are checked.
Result<std::optional<std::set<std::string>>> filesToCheck(const CheckOptions &options,
                                                          const CheckArguments &arguments) {
  if (!arguments.change.isAsked())
    return filesOf(arguments.shard, options, knownNames());
  if (auto complaint = complaintAbout(arguments.change, options))
    return Error{std::move(*complaint)};
  Result<Affected> found = affected(arguments.change, options, knownNames());
  if (!found)
    return found.error();
  return std::optional(found.take().programs);
}

int runCheck(const CheckArguments &arguments, const CLI::App &command) {
  const std::optional<Baseline> baseline = baselineToStart(complaintAbout(arguments), arguments.baseline);
  if (!baseline)
    return kExitCouldNotRun;
  CheckOptions options = toOptions(arguments);
  Result<std::optional<std::set<std::string>>> files = filesToCheck(options, arguments);
  if (!files) {
    printError(files.error().message);
    return kExitCouldNotRun;
  }
  options.only = files.take();
  ProgressLine progress;
  if (!arguments.quiet)
    options.progress = [&](std::size_t done, std::size_t all) { progress.show(done, all); };
  if (arguments.fix || arguments.diff)
    return repair(options, arguments, progress);
  Answers kept;
  CheckResult result = check(options, knownNames(),
                             {.kept = arguments.shard.part.empty() ? nullptr : &kept, .given = arguments.shard.given});
  progress.clear();
  complainIfNothingWasChecked(result, arguments);
  if (const auto error = writePartOf(arguments.shard, command, kept, {})) {
    printError(error->message);
    return kExitCouldNotRun;
  }
  if (arguments.baseline.update)
    return updateBaseline(result, *baseline, arguments);
  if (arguments.baseline.isAsked())
    return presentNew(std::move(result), *baseline, arguments);
  return present(result, arguments);
}

Stamps stampsFor(const CheckArguments &arguments) {
  std::vector<std::string> own;
  if (!arguments.output.empty())
    own.push_back(arguments.output);
  return stampsOf(arguments.paths.empty() ? std::vector<std::string>{"."} : arguments.paths, own);
}

/// Waits until files are no longer as they were, and no longer changing: an editor may write in several steps.
Stamps waitForChange(Stamps before, const CheckArguments &arguments) {
  constexpr std::chrono::milliseconds kPause(300); // also on network drives, which do not tell of changes
  bool isChanged = false;
  for (;;) {
    std::this_thread::sleep_for(kPause);
    Stamps now = stampsFor(arguments);
    const bool isSame = now == before;
    if (isSame && isChanged)
      return now;
    isChanged = isChanged || !isSame;
    before = std::move(now);
  }
}

/// Never comes back but for a failing output: Ctrl-C ends the program.
int watch(const CheckArguments &arguments, const CLI::App &command) {
  for (Stamps stamps = stampsFor(arguments);; stamps = waitForChange(std::move(stamps), arguments)) {
    runCheck(arguments, command);
    if (!outputArrived())
      return kExitCouldNotRun;
    printAside(
        fmt::format("--- watching {} file{}; stop with Ctrl-C ---\n", stamps.size(), stamps.size() == 1 ? "" : "s"));
  }
}

} // namespace

Command addCheckCommand(CLI::App &parent, const Answers *given) {
  CLI::App *app = parent.add_subcommand("check", "report mistakes in programs");
  app->footer("Exit codes: 0 no findings, 1 findings, 2 the command could not run.\n"
              "Example: feedhold check --fix nc/");
  const auto arguments = std::make_shared<CheckArguments>();
  addOptions(*app, *arguments);
  arguments->shard.given = given;
  return {app, [app, arguments] {
            return arguments->watch && !complaintAbout(*arguments) ? watch(*arguments, *app)
                                                                   : runCheck(*arguments, *app);
          }};
}

} // namespace feedhold
