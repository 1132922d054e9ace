// `feedhold ranges FILE[:LINE]`: what is known before each block, for all inputs.
#include "dialects/registry.h"
#include "findings/session/ranges.h"
#include "rules/registry.h"
#include "surface/cli/commands.h"
#include "surface/cli/shared_options.h"
#include "surface/cli/terminal.h"
#include "surface/sink/ranges_sink.h"

#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <string>
#include <vector>

namespace feedhold {

namespace {

struct RangesArguments {
  std::string path;
  std::string program;
  bool calls = false;
  ControlArguments control;
  ConfigArguments config;
  std::string format = "text";
};

void addOptions(CLI::App &app, RangesArguments &arguments) {
  app.add_option("file", arguments.path, "program file, or FILE:LINE; called programs are found in its folder")
      ->type_name("FILE")
      ->required();
  app.add_option("--program", arguments.program, "program of the file to start (default: all that no other calls)")
      ->type_name("PROGRAM");
  app.add_flag("--calls", arguments.calls, "also print the blocks of called programs in other files");
  addControl(app, arguments.control);
  addConfiguration(app, arguments.config);
  addFormat(app, arguments.format, {"text", "json"});
}

struct PathAndLine {
  std::string path;
  std::optional<std::uint32_t> line;
};
/// A path may itself end like a line.
PathAndLine pathAndLine(const std::string &text) {
  const std::size_t colon = text.rfind(':');
  std::error_code ignored;
  if (colon == std::string::npos || colon + 1 == text.size() || std::filesystem::exists(text, ignored))
    return {text, std::nullopt};
  std::uint32_t line = 0;
  const char *end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data() + colon + 1, end, line);
  if (error != std::errc() || at != end)
    return {text, std::nullopt};
  return {text.substr(0, colon), line};
}

Result<std::string> ranges(const RangesArguments &arguments) {
  const PathAndLine asked = pathAndLine(arguments.path);
  ProgramOptions options{.path = asked.path};
  if (asked.path == "-")
    options.piped = PipedText{"<stdin>", readStandardInput()};
  if (const auto complaint = complaintAbout(arguments.control))
    return Error{*complaint};
  options.control = controlFrom(arguments.control);
  options.config = configFrom(arguments.config);
  const auto loaded = loadProject(options, {allDialects(), allRules()});
  if (!loaded)
    return loaded.error();
  const Project &programs = *loaded.value();

  const auto program = arguments.program.empty() ? std::nullopt : std::optional(arguments.program);
  const auto files = arguments.calls ? RangesOptions::Files::All : RangesOptions::Files::First;
  const Result<BlockStates> states = rangesOf(programs, {program, asked.line, files});
  if (!states)
    return Error{asked.path + ": " + states.error().message};
  std::vector<std::string> shown;
  for (const auto &file : programs.files)
    shown.push_back(file->shown);
  const RangesReport report{*programs.set, shown, states.value(), asked.line};
  return arguments.format == "json" ? writeRangesJson(report) : writeRangesText(report);
}

int rangesOrComplain(const RangesArguments &arguments) {
  const Result<std::string> text = ranges(arguments);
  if (!text) {
    printError(text.error().message);
    return kExitCouldNotRun;
  }
  print(text.value());
  return kExitClean;
}

} // namespace

Command addRangesCommand(CLI::App &parent) {
  CLI::App *app = parent.add_subcommand("ranges", "print the possible values before each block, over all inputs");
  const auto arguments = std::make_shared<RangesArguments>();
  addOptions(*app, *arguments);
  return {app, [arguments] { return rangesOrComplain(*arguments); }};
}

} // namespace feedhold
