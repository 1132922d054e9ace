// The program `feedhold`: reads the command line and runs one sub-command.
#include "surface/cli/commands.h"
#include "surface/cli/platform.h"
#include "surface/cli/terminal.h"

#include <algorithm>
#include <exception>
#include <string>
#include <vector>

namespace {

int run(std::vector<std::string> words) {
  using namespace feedhold;
  CLI::App app("Static analyser, linter and prover for CNC macro programs", "feedhold");
  app.allow_windows_style_options(false); // `//server/programs` is a path
  app.set_help_flag("-h,--help", "print this help and exit");
  app.set_version_flag("--version", std::string("feedhold ") + FEEDHOLD_VERSION, "print the version and exit");
  app.get_formatter()->label("Positionals", "Arguments");
  app.get_formatter()->label("SUBCOMMAND", "COMMAND");
  app.get_formatter()->label("Excludes", "not with");
  app.get_formatter()->label("Needs", "needs");
  app.require_subcommand(1);
  const std::vector<Command> commands = {
      addCheckCommand(app), addRunCommand(app),       addPlotCommand(app),        addExplainCommand(app),
      addRulesCommand(app), addDialectsCommand(app),  addTokensCommand(app),      addTreeCommand(app),
      addModelCommand(app), addCfgCommand(app),       addRangesCommand(app),      addProveCommand(app),
      addMergeCommand(app), addDraftCommand(app),     addCertifyCommand(app),     addRecheckCommand(app),
      addLspCommand(app),   addSelfCheckCommand(app), addCompletionsCommand(app), addManCommand(app)};
  // Only now: the commands would take it over.
  app.footer("`feedhold COMMAND --help` describes the options of a command; `feedhold check FOLDER` is a good start.");
  try {
    std::reverse(words.begin(), words.end()); // as CLI11 takes them
    app.parse(std::move(words));
  } catch (const CLI::ParseError &error) {
    return app.exit(error) == 0 ? kExitClean : kExitCouldNotRun;
  }
  for (const Command &command : commands)
    if (command.app->parsed())
      return command.run();
  return kExitCouldNotRun;
}

} // namespace

int main(int argc, char **argv) {
  try {
    const int exitCode = run(feedhold::beginProgram(argc, argv));
    if (feedhold::outputArrived())
      return exitCode;
    feedhold::printError("standard output cannot be written; is the disk full?");
    return feedhold::kExitCouldNotRun;
  } catch (const std::exception &error) {
    feedhold::printError(error.what());
    return feedhold::kExitCouldNotRun;
  }
}
