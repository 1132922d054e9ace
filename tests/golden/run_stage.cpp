#include "golden/run_stage.h"

#include "base/support/text.h"
#include "dialects/registry.h"
#include "findings/project/project.h"
#include "rules/registry.h"
#include "surface/sink/run_sink.h"

#include <cstdlib>
#include <fmt/format.h>
#include <sstream>

namespace feedhold::golden {

namespace {

struct Wish {
  RunOptions options;
  bool trace = false;
};

/// `0,0,1`
std::vector<double> numbersOf(const std::string &text) {
  std::vector<double> numbers;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');)
    numbers.push_back(std::strtod(part.c_str(), nullptr));
  return numbers;
}

/// Takes down one word of what follows the name of the stage; false when it means nothing.
bool take(const std::string &word, const Dialect &dialect, Wish &options) {
  const std::size_t equals = word.find('=');
  const double value = std::strtod(word.c_str() + (equals == std::string::npos ? 1 : equals + 1), nullptr);
  if (word == "trace")
    options.trace = true;
  else if (word == "block-skip")
    options.options.blockSkip = BlockSkipSwitch::On;
  else if (word == "numbers=mantissa32")
    options.options.numbers = NumberModel::Mantissa32;
  else if (word == "numbers=binary64")
    options.options.numbers = NumberModel::Binary64;
  else if (word.starts_with("fuel="))
    options.options.fuel = static_cast<std::uint64_t>(value);
  else if (word.starts_with('#') && word.find(',') != std::string::npos)
    options.options.variables.readings.set(static_cast<std::uint32_t>(std::atoi(word.c_str() + 1)),
                                           numbersOf(word.substr(equals + 1)));
  else if (word.starts_with('#'))
    options.options.variables.set(static_cast<std::uint32_t>(std::atoi(word.c_str() + 1)), ConcreteValue::of(value));
  else if (equals == 1 && isLetter(word.front()))
    options.options.variables.set(dialect.argumentVariables[static_cast<std::size_t>(word.front() - 'A')],
                                  ConcreteValue::of(value));
  else if (const auto axis = axisOf(word.front()))
    options.options.start[indexOf(*axis)] = value;
  else
    return false;
  return true;
}

/// The first instruction of each block that is executed.
std::vector<TracedBlock> traceOf(const ProgramSet &programs, Callee entry, RunOptions options) {
  std::vector<TracedBlock> blocks;
  std::optional<Place> last;
  options.trace = [&](const RunMoment &moment) {
    const auto blockOf = [&](Place place) { return programs.node(place).block; };
    const bool goesOn = last && last->file == moment.place.file && blockOf(*last) == blockOf(moment.place) &&
                        last->node < moment.place.node;
    last = moment.place;
    if (!goesOn)
      blocks.push_back({moment.place, moment.depth, moment.moves});
  };
  run(programs, entry, options);
  return blocks;
}

} // namespace

std::string runStageOf(const Input &input, std::string_view wishes) {
  ProgramOptions asked{.path = input.files.front().name, .control = {.dialect = std::string(input.dialect->id)}};
  asked.config.source = input.config ? ConfigSource::Nearest : ConfigSource::None;
  const auto loaded = loadProject(asked, {allDialects(), allRules()});
  if (!loaded)
    return loaded.error().message + "\n";
  const Project &programs = *loaded.value();
  Wish options{.options = {.numbers = numbersOfRun(programs.dialect()), .cutter = CutterCompensation::Followed}};
  std::istringstream words{std::string(wishes)};
  for (std::string word; words >> word;)
    if (!take(word, programs.dialect(), options))
      return fmt::format("`{}` says nothing about a run\n", word);
  const std::optional<Callee> start = startOf(programs, std::nullopt);
  if (!start)
    return "no program\n";
  const RunResult result = run(*programs.set, *start, options.options);
  const auto trace = options.trace ? traceOf(*programs.set, *start, options.options) : std::vector<TracedBlock>{};
  std::vector<std::string> shown;
  for (const auto &file : programs.files)
    shown.push_back(file->shown);
  return writeRunText({*programs.set, shown, *start, result, options.options.numbers, trace});
}

} // namespace feedhold::golden
