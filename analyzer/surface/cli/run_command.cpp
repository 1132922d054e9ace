// `feedhold run FILE`: executes a program with the numbers given, and prints what the machine does.
#include "surface/cli/commands.h"
#include "surface/cli/run_input.h"
#include "surface/cli/shared_options.h"
#include "surface/cli/terminal.h"
#include "surface/sink/run_sink.h"

#include <memory>
#include <string>
#include <vector>

namespace feedhold {

namespace {

struct RunArguments {
  RunInput input;
  std::string format = "text";
  bool trace = false;
};

void addOptions(CLI::App &app, RunArguments &arguments) {
  addRunInput(app, arguments.input);
  app.add_flag("--trace", arguments.trace, "print every block that is executed");
  addFormat(app, arguments.format, {"text", "json"});
}

/// Takes down each block as it begins.
class Trace {
public:
  explicit Trace(const ProgramSet &programs) : programs_(programs) {}
  void operator()(const RunMoment &moment) {
    const BlockId block = programs_.node(moment.place).block;
    const bool goesOn = last_ && last_->file == moment.place.file && programs_.node(*last_).block == block &&
                        last_->node < moment.place.node;
    last_ = moment.place;
    if (!goesOn && blocks.size() < kMostBlocks)
      blocks.push_back({moment.place, moment.depth, moment.moves});
  }
  std::vector<TracedBlock> blocks;

private:
  static constexpr std::size_t kMostBlocks = 1'000'000;
  const ProgramSet &programs_;
  std::optional<Place> last_;
};

Result<int> runProgram(const RunArguments &arguments) {
  auto prepared = prepareRun(arguments.input);
  if (!prepared)
    return prepared.error();
  PreparedRun ready = prepared.take();
  const Project &programs = *ready.programs;
  Trace trace(*programs.set);
  if (arguments.trace)
    ready.options.trace = std::ref(trace);
  const RunResult result = run(*programs.set, ready.start, ready.options);
  std::vector<std::string> shown;
  for (const auto &file : programs.files)
    shown.push_back(file->shown);
  const RunReport report{*programs.set, shown, ready.start, result, ready.options.numbers, trace.blocks};
  print(arguments.format == "json" ? writeRunJson(report) : writeRunText(report));
  return hasEnded(result.end) ? kExitClean : kExitFindings;
}

int runOrComplain(const RunArguments &arguments) {
  const Result<int> exitCode = runProgram(arguments);
  if (exitCode)
    return exitCode.value();
  printError(exitCode.error().message);
  return kExitCouldNotRun;
}

} // namespace

Command addRunCommand(CLI::App &parent) {
  CLI::App *app = parent.add_subcommand("run", "execute a program; print its tool path, variables and alarms");
  const auto arguments = std::make_shared<RunArguments>();
  addOptions(*app, *arguments);
  return {app, [arguments] { return runOrComplain(*arguments); }};
}

} // namespace feedhold
