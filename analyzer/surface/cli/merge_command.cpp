// `feedhold merge PARTS`: joins what the shards of `check`, `prove` or `certify` have found into what one run would
// have written. It is that run, which takes its answers from the parts.
#include "surface/cli/baseline_file.h"
#include "surface/cli/command_words.h"
#include "surface/cli/commands.h"
#include "surface/cli/shard_options.h"
#include "surface/cli/shared_options.h"
#include "surface/cli/terminal.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

namespace feedhold {

namespace {

constexpr std::array<std::string_view, 3> kCommands = {"check", "prove", "certify"};

/// Those of the commands that decide how results are told, not what they are.
struct MergeArguments {
  std::vector<std::string> parts;
  std::string format;
  std::string output;
  std::string color = "auto";
  bool showSuppressed = false;
  bool verbose = false;
  bool quiet = false;
  bool statistics = false;
  bool exitZero = false;
  BaselineOptions baseline;
};

void addOptions(CLI::App &app, MergeArguments &arguments) {
  app.add_option("parts", arguments.parts, "files that --part has written, and folders with such files")
      ->type_name("PART")
      ->required();
  app.add_option("--format", arguments.format, "output format (default: as the shards were told)")
      ->type_name("FORMAT")
      ->check(CLI::IsMember({"text", "concise", "json", "sarif", "junit", "github"}));
  app.add_option("--output", arguments.output,
                 "write the findings of check to this file, the report of certify to this folder")
      ->type_name("PATH");
  addColor(app, arguments.color);
  app.add_flag("--show-suppressed", arguments.showSuppressed, "also print findings that @ALLOW suppresses (of check)");
  app.add_flag("-v,--verbose", arguments.verbose, "print how each proof was found and what it cost (of prove)");
  addQuiet(app, arguments.quiet);
  app.add_flag("--statistics", arguments.statistics, "print numbers instead of the findings or the verdicts");
  app.add_flag("--exit-zero", arguments.exitZero, "exit with 0 even if there are findings (of check)");
  addBaselineOptions(app, arguments.baseline);
}

/// Runs the command of the parts with their answers; returns the exit code.
int runCommand(const RunPart &run, std::vector<std::string> words) {
  Answers answers;
  for (const auto &[key, record] : run.answers)
    answers.add(key, record);
  CLI::App app("", "feedhold");
  const std::string &name = run.command.front();
  const Command command = name == "prove"     ? addProveCommand(app, &answers)
                          : name == "certify" ? addCertifyCommand(app, &answers)
                                              : addCheckCommand(app, &answers);
  try {
    words.insert(words.begin(), run.command.front());
    std::reverse(words.begin(), words.end()); // as CLI11 takes them
    app.parse(std::move(words));
  } catch (const CLI::ParseError &error) {
    printError(fmt::format("the parts are of `feedhold {}`: {}", run.command.front(), error.what()));
    return kExitCouldNotRun;
  }
  return command.run();
}

int merge(const MergeArguments &arguments, const CLI::App &app) {
  Result<std::vector<RunPart>> parts = readParts(arguments.parts);
  const Result<RunPart> run = parts ? joinParts(parts.take()) : Result<RunPart>(parts.error());
  if (!run) {
    printError(run.error().message);
    return kExitCouldNotRun;
  }
  if (run.value().command.empty() || !std::ranges::count(kCommands, run.value().command.front())) {
    printError("the parts are of no command whose parts can be joined");
    return kExitCouldNotRun;
  }
  if (run.value().prover != proverOfParts(run.value().command.front())) {
    printError(fmt::format("the parts were proved with {}; here is {}", run.value().prover,
                           proverOfParts(run.value().command.front())));
    return kExitCouldNotRun;
  }
  if (run.value().tool != toolOfParts()) {
    printError(fmt::format("the parts were made by another build of feedhold ({}); this is {}", run.value().tool,
                           toolOfParts()));
    return kExitCouldNotRun;
  }
  const std::vector<std::string> own(run.value().command.begin() + 1, run.value().command.end());
  return runCommand(run.value(), replaced(own, wordsOf(app, {})));
}

} // namespace

Command addMergeCommand(CLI::App &parent) {
  CLI::App *app = parent.add_subcommand("merge", "join the results of shards into those of one run");
  app->footer("Run it in the folder in which the shards ran, with the same files.\n"
              "Exit codes: those of the command that the shards ran.\n"
              "Example: feedhold merge parts/ --format sarif");
  const auto arguments = std::make_shared<MergeArguments>();
  addOptions(*app, *arguments);
  return {app, [app, arguments] { return merge(*arguments, *app); }};
}

} // namespace feedhold
