#include "surface/plot/run_picture.h"

#include "base/support/text.h"
#include "language/syntax/tree.h"
#include "meaning/semantics/tool_length.h"
#include "proof/replay/example_run.h"
#include "proof/space/plain_space.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace feedhold {

namespace {

const ProgramFile &fileOf(const PicturedRun &run, Place place) { return run.programs.set->file(place.file); }
BlockId blockIdOf(const PicturedRun &run, Place place) { return run.programs.set->node(place).block; }
std::string programAt(const PicturedRun &run, Place place) {
  const ProgramModel &model = *fileOf(run, place).model;
  return toString(model.programs[model.programOf(blockIdOf(run, place))].name);
}

/// `O9311 line 12: N40 G01 X10.`
std::string blockOf(const PicturedRun &run, const RecordedMove &move) {
  const ProgramFile &file = fileOf(run, move.place);
  const std::uint32_t line = file.source->lineOf(file.tree->blocks[blockIdOf(run, move.place)].begin);
  const std::string text = file.source->utf8(file.source->lineSpan(line));
  return fmt::format("{} line {}: {}", programAt(run, move.place), line, trimmed(text));
}

/// `N40`, `line 7`, `N40 of O9311` where it is not in the program that was started.
std::string placeOf(const PicturedRun &run, Place place) {
  const ProgramFile &file = fileOf(run, place);
  const BlockId block = blockIdOf(run, place);
  const auto numbers = file.model->sequenceNumbersIn(block, block.next());
  std::string text = numbers.empty() ? fmt::format("line {}", file.source->lineOf(file.tree->blocks[block].begin))
                                     : fmt::format("N{}", numbers.front().number);
  const std::string program = programAt(run, place);
  return program == startedProgram(run) ? text : fmt::format("{} of {}", text, program);
}

struct Gouges {
  std::vector<PlottedGouge> all;       // where the run breaks each clause most; the deepest first
  std::vector<std::string> byRounding; // a proof takes words as they are written, and would not see them
};

Gouges gougesOf(const PicturedRun &run, const geometry::PlainSpace &space) {
  using geometry::SpaceClaim;
  Gouges gouges;
  std::optional<RunResult> unrounded;
  const auto isByRounding = [&](SpaceClaim claim, std::size_t region) {
    if (!unrounded) {
      RunOptions options = run.options;
      options.words = WordRounding::None;
      unrounded = feedhold::run(*run.programs.set, run.start, options);
    }
    return !geometry::deepestGouge(space, claim, region, unrounded->moves);
  };
  const auto look = [&](SpaceClaim claim, std::size_t region) {
    const auto gouge = geometry::deepestGouge(space, claim, region, run.result.moves);
    if (!gouge)
      return;
    const RecordedMove &move = run.result.moves[gouge->move];
    std::string text = gougeText(space, claim, region, *gouge, move.unit, placeOf(run, move.place));
    if (isByRounding(claim, region))
      gouges.byRounding.push_back(text + ", only because words are rounded to the least increment");
    else
      gouges.all.push_back({*gouge, std::move(text)});
  };
  for (std::size_t i = 0; i < space.keepIn.size(); ++i)
    look(SpaceClaim::KeepIn, i);
  for (std::size_t i = 0; i < space.keepOut.size(); ++i)
    look(SpaceClaim::KeepOut, i);
  look(SpaceClaim::Clearance, 0);
  look(SpaceClaim::Travel, 0);
  look(SpaceClaim::Machine, 0);
  std::stable_sort(gouges.all.begin(), gouges.all.end(),
                   [](const PlottedGouge &a, const PlottedGouge &b) { return a.gouge.depth > b.gouge.depth; });
  return gouges;
}

std::vector<std::string> notesOf(const PicturedRun &run) {
  constexpr std::size_t kMostNotes = 4;
  std::vector<std::string> notes;
  if (!hasEnded(run.result.end))
    notes.push_back(fmt::format("{}: the run does not finish ({}); it stops at {}", run.name, nameOf(run.result.end),
                                placeOf(run, run.result.place)));
  for (const RunNote &note : run.result.notes)
    if (notes.size() < kMostNotes)
      notes.push_back(fmt::format("not modelled: {}, {}", note.reason, placeOf(run, note.place)));
  return notes;
}

/// What the contract asks for and the run does not have.
struct MissingInputs {
  std::vector<std::string> ofRegions; // without them there are none
  std::vector<std::string> ofSetUp;   // without them machine coordinates are not known
};

/// A cell of the control that is not given holds 0.
bool mayBeZero(const PicturedRun &run, const FileContracts &contracts, const EntryValue &value) {
  const auto *range = std::get_if<Range>(&value.values);
  const auto number = [&](ExpressionId end) {
    return prove::numberOf(*run.programs.set, run.start, contracts, run.options, end);
  };
  return range && (!range->low || number(*range->low) <= 0) && (!range->high || number(*range->high) >= 0);
}

/// The run has the length of some tool.
bool hasLength(const PicturedRun &run, const Dialect &dialect) {
  return std::ranges::any_of(run.options.variables.entries(),
                             [&](const auto &given) { return isLengthVariable(dialect, given.first); });
}

MissingInputs missingInputs(const PicturedRun &run) {
  MissingInputs missing;
  const ProjectFile &file = run.programs.file(run.start.file);
  const Contract *contract = file.contracts.of(run.start.program);
  if (contract == nullptr)
    return missing;
  for (const auto *values : {&contract->params, &contract->globals})
    for (const EntryValue &value : *values) {
      if (value.vacancy == Vacancy::Possible || run.options.variables.find(value.variable))
        continue;
      const ClauseKind kind = file.contracts.clauses[value.clause].kind;
      const bool isOfSetUp = kind == ClauseKind::Offset || kind == ClauseKind::Machine;
      if (!isOfSetUp)
        missing.ofRegions.push_back(run.programs.set->nameOfVariable(value.variable));
      else if (!mayBeZero(run, file.contracts, value))
        missing.ofSetUp.push_back(run.programs.set->nameOfVariable(value.variable));
    }
  if (!contract->lengths.empty() && !hasLength(run, *file.dialect))
    missing.ofSetUp.push_back("the tool length");
  return missing;
}

} // namespace

std::string startedProgram(const PicturedRun &run) {
  return toString(run.programs.set->file(run.start.file).model->programs[run.start.program].name);
}

RunPicture drawRuns(const std::string &title, std::span<const PicturedRun> runs) {
  Picture picture{.title = title, .runs = {}};
  for (const PicturedRun &run : runs) {
    picture.runs.push_back(
        {run.name, run.result.moves, [&run](const RecordedMove &move) { return blockOf(run, move); }});
    for (std::string &note : notesOf(run))
      picture.notes.push_back(std::move(note));
  }
  const PicturedRun &first = runs.front();
  picture.isLathe = first.programs.set->file(first.start.file).dialect->machine == MachineKind::Turning;
  const MissingInputs missing = missingInputs(first);
  if (missing.ofRegions.empty())
    picture.space = prove::plainSpace(*first.programs.set, first.start, first.programs.file(first.start.file).contracts,
                                      first.options);
  else
    picture.notes.push_back(
        fmt::format("regions of the contract are not drawn: they need {}", fmt::join(missing.ofRegions, " ")));
  if (picture.space.machine && !missing.ofSetUp.empty()) {
    picture.space.machine.reset();
    picture.notes.push_back(
        fmt::format("the range of the machine is not checked: it needs {}", fmt::join(missing.ofSetUp, " ")));
  }
  Gouges gouges = gougesOf(first, picture.space);
  for (std::string &text : gouges.byRounding)
    picture.notes.push_back(std::move(text));
  RunPicture drawn{"", picture.notes, {}};
  for (const PlottedGouge &gouge : gouges.all) {
    drawn.gouges.push_back(gouge.text);
    if (&gouge == &gouges.all.front())
      picture.gouge = gouge;
    else
      picture.notes.push_back(gouge.text);
  }
  drawn.svg = drawPicture(picture);
  return drawn;
}

} // namespace feedhold
