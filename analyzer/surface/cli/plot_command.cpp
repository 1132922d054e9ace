// `feedhold plot FILE`: draws the tool path of a run as one SVG, with the space that its contract gives it.
#include "base/source/write_file.h"
#include "surface/cli/commands.h"
#include "surface/cli/run_input.h"
#include "surface/cli/terminal.h"
#include "surface/plot/run_picture.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

namespace feedhold {

namespace {

struct PlotArguments {
  RunInput input;
  std::string output;
  std::string compare;
  std::vector<std::string> compareArguments;
};

void addOptions(CLI::App &app, PlotArguments &arguments) {
  addRunInput(app, arguments.input);
  app.add_option("-o,--output", arguments.output, "write the image to this file (default: standard output)")
      ->type_name("FILE");
  app.add_option("--compare", arguments.compare,
                 "draw the run of a second file over the first, with the same arguments")
      ->type_name("FILE");
  app.add_option("--compare-arg", arguments.compareArguments,
                 "argument of the second run where it differs: A=12 (may be repeated)")
      ->type_name("LETTER=VALUE")
      ->allow_extra_args(false);
}

struct PlottedProgram {
  PreparedRun prepared;
  RunResult result;
  std::string values; // of the arguments, as they were given

  PicturedRun run() const {
    PicturedRun run{*prepared.programs, prepared.start, prepared.options, result, {}};
    run.name = startedProgram(run) + (values.empty() ? std::string() : " with " + values);
    return run;
  }
};

Result<PlottedProgram> plotted(const RunInput &input) {
  auto prepared = prepareRun(input);
  if (!prepared)
    return prepared.error();
  PreparedRun ready = prepared.take();
  RunResult result = run(*ready.programs->set, ready.start, ready.options);
  return PlottedProgram{std::move(ready), std::move(result), fmt::format("{}", fmt::join(input.arguments, " "))};
}

/// The legend tells the rest.
std::string titleOf(std::span<const PicturedRun> runs) {
  if (runs.size() == 1)
    return runs[0].name;
  const std::string one = startedProgram(runs[0]);
  const std::string other = startedProgram(runs[1]);
  return one == other ? one + ", two runs" : fmt::format("{} and {}", one, other);
}

struct DrawnPlot {
  std::string svg;
  std::vector<std::string> said; // to who draws it
  int exitCode;
};

DrawnPlot drawn(const PlottedProgram &first, const std::optional<PlottedProgram> &second) {
  std::vector<PicturedRun> runs = {first.run()};
  if (second)
    runs.push_back(second->run());
  RunPicture picture = drawRuns(titleOf(runs), runs);
  DrawnPlot plot{std::move(picture.svg), std::move(picture.notes), kExitFindings};
  if (hasEnded(first.result.end) && picture.gouges.empty())
    plot.exitCode = kExitClean;
  for (std::string &text : picture.gouges)
    plot.said.push_back(std::move(text));
  return plot;
}

/// In the place of the one of its letter.
void setArgument(std::vector<std::string> &arguments, const std::string &argument) {
  const std::string letter = argument.substr(0, argument.find('=') + 1);
  const auto same = std::find_if(arguments.begin(), arguments.end(), [&](const std::string &given) {
    return !letter.empty() && given.starts_with(letter);
  });
  if (same == arguments.end())
    arguments.push_back(argument);
  else
    *same = argument;
}

Result<int> plot(const PlotArguments &arguments) {
  const auto first = plotted(arguments.input);
  if (!first)
    return first.error();
  std::optional<PlottedProgram> second;
  if (!arguments.compare.empty() || !arguments.compareArguments.empty()) {
    RunInput input = arguments.input;
    if (!arguments.compare.empty())
      input.path = arguments.compare;
    for (const std::string &argument : arguments.compareArguments)
      setArgument(input.arguments, argument);
    auto other = plotted(input);
    if (!other)
      return other.error();
    second = other.take();
  }
  const DrawnPlot plot = drawn(first.value(), second);
  if (arguments.output.empty())
    print(plot.svg);
  else if (const auto error = writeFile(arguments.output, plot.svg))
    return *error;
  for (const std::string &line : plot.said)
    printAside(line + "\n");
  return plot.exitCode;
}

int plotOrComplain(const PlotArguments &arguments) {
  const Result<int> exitCode = plot(arguments);
  if (exitCode)
    return exitCode.value();
  printError(exitCode.error().message);
  return kExitCouldNotRun;
}

} // namespace

Command addPlotCommand(CLI::App &parent) {
  CLI::App *app = parent.add_subcommand("plot", "execute a program and draw its tool path as an SVG image");
  const auto arguments = std::make_shared<PlotArguments>();
  addOptions(*app, *arguments);
  return {app, [arguments] { return plotOrComplain(*arguments); }};
}

} // namespace feedhold
