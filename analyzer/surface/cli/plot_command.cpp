// `feedhold plot FILE`: draws the tool path of a run as one SVG, with the space that its contract gives it.
#include "base/source/write_file.h"
#include "base/support/text.h"
#include "language/syntax/tree.h"
#include "proof/prove/plain_space.h"
#include "surface/cli/commands.h"
#include "surface/cli/run_input.h"
#include "surface/cli/terminal.h"
#include "surface/sink/plot_sink.h"

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
  app.add_option("-o,--output", arguments.output, "write to this file (default: standard output)");
  app.add_option("--compare", arguments.compare, "draw the run of this file over it, with the same arguments");
  app.add_option("--compare-arg", arguments.compareArguments, "an argument that the second run has instead: A=12")
      ->allow_extra_args(false);
}

struct PlottedProgram {
  PreparedRun prepared;
  RunResult result;
  std::string name; // of the run, for people

  const ProgramFile &file(Place place) const { return prepared.programs->set->file(place.file); }
  BlockId block(Place place) const { return prepared.programs->set->node(place).block; }
  std::string program(Place place) const {
    const ProgramModel &model = *file(place).model;
    return toString(model.programs[model.programOf(block(place))].name);
  }
};

std::string startedProgram(const PreparedRun &prepared) {
  return toString(prepared.programs->set->file(prepared.start.file).model->programs[prepared.start.program].name);
}

Result<PlottedProgram> plotted(const RunInput &input) {
  auto prepared = prepareRun(input);
  if (!prepared)
    return prepared.error();
  PreparedRun ready = prepared.take();
  const std::string name = startedProgram(ready);
  RunResult result = run(*ready.programs->set, ready.start, ready.options);
  const std::string values = fmt::format("{}", fmt::join(input.arguments, " "));
  return PlottedProgram{std::move(ready), std::move(result),
                        name + (values.empty() ? std::string() : " with " + values)};
}

/// `O9311 line 12: N40 G01 X10.`
std::string blockOf(const PlottedProgram &plotted, const RecordedMove &move) {
  const ProgramFile &file = plotted.file(move.place);
  const std::uint32_t line = file.source->lineOf(file.tree->blocks[plotted.block(move.place)].begin);
  const std::string text = file.source->utf8(file.source->lineSpan(line));
  return fmt::format("{} line {}: {}", plotted.program(move.place), line, trimmed(text));
}

/// `N40`, `line 7`, `N40 of O9311` where it is not in the program that was started.
std::string placeOf(const PlottedProgram &plotted, Place place) {
  const ProgramFile &file = plotted.file(place);
  const BlockId block = plotted.block(place);
  const auto numbers = file.model->sequenceNumbersIn(block, block.next());
  std::string text = numbers.empty() ? fmt::format("line {}", file.source->lineOf(file.tree->blocks[block].begin))
                                     : fmt::format("N{}", numbers.front().number);
  const std::string program = plotted.program(place);
  return program == startedProgram(plotted.prepared) ? text : fmt::format("{} of {}", text, program);
}

struct Gouges {
  std::vector<PlottedGouge> all;       // where the run breaks each clause most; the deepest first
  std::vector<std::string> byRounding; // a proof takes words as they are written, and would not see them
};

Gouges gougesOf(const PlottedProgram &plotted, const geometry::PlainSpace &space) {
  using geometry::SpaceClaim;
  Gouges gouges;
  std::optional<RunResult> unrounded;
  const auto isByRounding = [&](SpaceClaim claim, std::size_t region) {
    if (!unrounded) {
      RunOptions options = plotted.prepared.options;
      options.words = WordRounding::None;
      unrounded = run(*plotted.prepared.programs->set, plotted.prepared.start, options);
    }
    return !geometry::deepestGouge(space, claim, region, unrounded->moves);
  };
  const auto look = [&](SpaceClaim claim, std::size_t region) {
    const auto gouge = geometry::deepestGouge(space, claim, region, plotted.result.moves);
    if (!gouge)
      return;
    const RecordedMove &move = plotted.result.moves[gouge->move];
    std::string text = gougeText(space, claim, region, gouge->depth, move.unit, placeOf(plotted, move.place));
    if (isByRounding(claim, region))
      gouges.byRounding.push_back(text + ", by the rounding of words to the least increment alone");
    else
      gouges.all.push_back({*gouge, std::move(text)});
  };
  for (std::size_t i = 0; i < space.keepIn.size(); ++i)
    look(SpaceClaim::KeepIn, i);
  for (std::size_t i = 0; i < space.keepOut.size(); ++i)
    look(SpaceClaim::KeepOut, i);
  look(SpaceClaim::Clearance, 0);
  look(SpaceClaim::Travel, 0);
  std::stable_sort(gouges.all.begin(), gouges.all.end(),
                   [](const PlottedGouge &a, const PlottedGouge &b) { return a.gouge.depth > b.gouge.depth; });
  return gouges;
}

std::vector<std::string> notesOf(const PlottedProgram &plotted) {
  constexpr std::size_t kMostNotes = 4;
  std::vector<std::string> notes;
  if (!hasEnded(plotted.result.end))
    notes.push_back(fmt::format("{}: the run does not come to its end ({}) but stops at {}", plotted.name,
                                nameOf(plotted.result.end), placeOf(plotted, plotted.result.place)));
  for (const RunNote &note : plotted.result.notes)
    if (notes.size() < kMostNotes)
      notes.push_back(fmt::format("not followed: {}, {}", note.reason, placeOf(plotted, note.place)));
  return notes;
}

/// What the contract asks for and the run does not have: without it there are no regions.
std::vector<std::string> missingArguments(const PreparedRun &prepared) {
  std::vector<std::string> missing;
  const LoadedPrograms &programs = *prepared.programs;
  const Contract *contract = programs.file(prepared.start.file).contracts.of(prepared.start.program);
  if (contract == nullptr)
    return missing;
  for (const auto *values : {&contract->params, &contract->globals})
    for (const EntryValue &value : *values)
      if (value.vacancy == Vacancy::Never && !prepared.options.variables.find(value.variable))
        missing.push_back(programs.set->nameOfVariable(value.variable));
  return missing;
}

geometry::PlainSpace spaceOf(const PreparedRun &prepared) {
  const LoadedPrograms &programs = *prepared.programs;
  return prove::plainSpace(*programs.set, prepared.start, programs.file(prepared.start.file).contracts,
                           prepared.options);
}

/// The legend tells the rest.
std::string titleOf(const PlottedProgram &first, const PlottedProgram &second) {
  const std::string one = startedProgram(first.prepared);
  const std::string other = startedProgram(second.prepared);
  return one == other ? one + ", two runs" : fmt::format("{} and {}", one, other);
}

struct DrawnPlot {
  std::string svg;
  std::vector<std::string> said; // to who draws it
  int exitCode;
};

DrawnPlot drawn(const PlottedProgram &first, const std::optional<PlottedProgram> &second) {
  Picture picture{.title = second ? titleOf(first, *second) : first.name, .runs = {}};
  for (const PlottedProgram *program : {&first, second ? &*second : nullptr}) {
    if (!program)
      continue;
    picture.runs.push_back({program->name, program->result.moves,
                            [program](const RecordedMove &move) { return blockOf(*program, move); }});
    for (std::string &note : notesOf(*program))
      picture.notes.push_back(std::move(note));
  }
  if (const auto missing = missingArguments(first.prepared); !missing.empty())
    picture.notes.push_back(
        fmt::format("without the space of the contract, which asks for {}", fmt::join(missing, " ")));
  else
    picture.space = spaceOf(first.prepared);
  const Gouges gouges = gougesOf(first, picture.space);
  for (const std::string &text : gouges.byRounding)
    picture.notes.push_back(text);
  DrawnPlot plot{"", picture.notes, hasEnded(first.result.end) ? kExitClean : kExitFindings};
  for (const PlottedGouge &gouge : gouges.all) {
    plot.said.push_back(gouge.text);
    plot.exitCode = kExitFindings;
    if (&gouge == &gouges.all.front())
      picture.gouge = gouge;
    else
      picture.notes.push_back(gouge.text);
  }
  plot.svg = drawPicture(picture);
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
  CLI::App *app = parent.add_subcommand("plot", "draw the tool path of a run as an SVG");
  const auto arguments = std::make_shared<PlotArguments>();
  addOptions(*app, *arguments);
  return {app, [arguments] { return plotOrComplain(*arguments); }};
}

} // namespace feedhold
