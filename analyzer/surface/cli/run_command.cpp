// `feedhold run FILE`: executes a program with the numbers given, and prints what the machine does.
#include "base/support/text.h"
#include "dialects/registry.h"
#include "findings/session/programs.h"
#include "language/syntax/tree.h"
#include "rules/registry.h"
#include "surface/cli/commands.h"
#include "surface/cli/terminal.h"
#include "surface/sink/run_sink.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace feedhold {

namespace {

struct RunArguments {
  std::string path;
  std::string program;
  std::vector<std::string> arguments;
  std::vector<std::string> variables;
  std::vector<std::string> start;
  std::uint64_t fuel = RunOptions{}.fuel;
  std::string dialect;
  std::string config;
  std::string format = "text";
  bool isolated = false;
  bool blockSkip = false;
  bool trace = false;
};

void addOptions(CLI::App &app, RunArguments &arguments) {
  app.add_option("file", arguments.path, "a program; others are found in its folder; - is standard input")->required();
  app.add_option("--program", arguments.program, "start at this program of the file (default: its first)");
  app.add_option("--arg", arguments.arguments, "an argument as a call passes it: A=10")->allow_extra_args(false);
  app.add_option("--var", arguments.variables, "a variable at the start: 500=3, <depth>=2.5")->allow_extra_args(false);
  app.add_option("--start", arguments.start, "where the tool stands at the start: X0 Y0 Z5");
  app.add_option("--fuel", arguments.fuel, "give up after this many instructions")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--block-skip", arguments.blockSkip, "pass over blocks with a /");
  app.add_flag("--trace", arguments.trace, "show every block that is executed");
  app.add_option("--dialect", arguments.dialect, "the control that runs it; `feedhold dialects` lists them");
  CLI::Option *config = app.add_option("--config", arguments.config, "use this configuration");
  app.add_flag("--isolated", arguments.isolated, "use no configuration")->excludes(config);
  app.add_option("--format", arguments.format, "text or json")->check(CLI::IsMember({"text", "json"}));
}

std::optional<double> numberFrom(std::string_view text) {
  if (text.starts_with('+'))
    text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

struct Setting {
  std::string name; // in front of the `=`
  double value;
};
Result<Setting> settingFrom(const std::string &text) {
  const std::size_t equals = text.rfind('=');
  const auto value = equals == std::string::npos ? std::nullopt : numberFrom(text.substr(equals + 1));
  if (!value)
    return Error{fmt::format("`{}` is no NAME=NUMBER", text)};
  return Setting{std::string(trimmed(text.substr(0, equals))), *value};
}

/// `A` by argument assignment I, or the number of a local variable.
std::optional<std::uint32_t> argumentVariable(const Dialect &dialect, std::string_view name) {
  if (name.size() != 1 || !isLetter(name.front()))
    return std::nullopt;
  const std::uint8_t variable = dialect.argumentVariables[static_cast<std::size_t>(toUpper(name.front()) - 'A')];
  return variable == 0 ? std::nullopt : std::optional<std::uint32_t>(variable);
}

/// `500`, `#500`, `<depth>`, `#<depth>`, or the name of a variable as programs write it.
std::optional<std::uint32_t> variableFrom(const ProgramSet &programs, std::string_view name) {
  if (name.starts_with('#'))
    name.remove_prefix(1);
  if (name.size() > 2 && name.starts_with('<') && name.ends_with('>'))
    return programs.variableNamed(comparedName(name.substr(1, name.size() - 2)));
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  const bool isNumber = error == std::errc() && end == name.data() + name.size();
  return isNumber && number > 0 && number < kFirstNamedVariable ? std::optional(number) : std::nullopt;
}

Result<GivenVariables> givenVariables(const RunArguments &arguments, const LoadedPrograms &programs) {
  GivenVariables given;
  for (const std::string &text : arguments.arguments) {
    const Result<Setting> setting = settingFrom(text);
    if (!setting)
      return Error{"--arg: " + setting.error().message};
    const auto variable = argumentVariable(programs.dialect, setting.value().name);
    if (!variable)
      return Error{fmt::format("--arg: `{}` is no letter that can be an argument here; --var sets any variable",
                               setting.value().name)};
    given.set(*variable, ConcreteValue::of(setting.value().value));
  }
  for (const std::string &text : arguments.variables) {
    const Result<Setting> setting = settingFrom(text);
    if (!setting)
      return Error{"--var: " + setting.error().message};
    const auto variable = variableFrom(*programs.set, setting.value().name);
    if (!variable)
      return Error{fmt::format("--var: no program has a variable `{}`", setting.value().name)};
    given.set(*variable, ConcreteValue::of(setting.value().value));
  }
  return given;
}

Result<std::array<double, kAxisCount>> startPosition(const RunArguments &arguments) {
  std::array<double, kAxisCount> start{};
  std::istringstream words(fmt::format("{}", fmt::join(arguments.start, " "))); // `--start X0 Y0` and `--start "X0 Y0"`
  for (std::string word; words >> word;) {
    const auto axis = axisOf(toUpper(word.front()));
    const auto value = axis ? numberFrom(std::string_view(word).substr(1)) : std::nullopt;
    if (!value)
      return Error{fmt::format("--start: `{}` is no coordinate such as X10.5", word)};
    start[indexOf(*axis)] = *value;
  }
  return start;
}

Result<std::unique_ptr<const LoadedPrograms>> load(const RunArguments &arguments) {
  ProgramsWish wish{.path = arguments.path};
  if (arguments.path == "-")
    wish.piped = PipedText{"<stdin>", readStandardInput()};
  if (!arguments.dialect.empty()) {
    if (const auto complaint = complaintAboutDialect(arguments.dialect, allDialects()))
      return Error{*complaint};
    wish.dialect = arguments.dialect;
  }
  if (arguments.isolated)
    wish.config.source = ConfigSource::None;
  else if (!arguments.config.empty())
    wish.config = {ConfigSource::Named, arguments.config};
  return loadPrograms(wish, {allDialects(), allRules()});
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

bool hasEnded(RunEnd end) {
  return end == RunEnd::M02 || end == RunEnd::M30 || end == RunEnd::Returned || end == RunEnd::EndOfFile;
}

Result<int> runProgram(const RunArguments &arguments) {
  const auto loaded = load(arguments);
  if (!loaded)
    return loaded.error();
  const LoadedPrograms &programs = *loaded.value();
  const auto name = arguments.program.empty() ? std::nullopt : std::optional(arguments.program);
  const std::optional<Callee> start = startOf(programs, name);
  if (!start)
    return Error{name ? fmt::format("{}: no program `{}` in it", arguments.path, *name)
                      : fmt::format("{}: no program in it", arguments.path)};
  Result<GivenVariables> variables = givenVariables(arguments, programs);
  if (!variables)
    return variables.error();
  const auto position = startPosition(arguments);
  if (!position)
    return position.error();

  Trace trace(*programs.set);
  RunOptions options{.variables = variables.take(),
                     .start = position.value(),
                     .fuel = arguments.fuel,
                     .blockSkip = arguments.blockSkip ? BlockSkipSwitch::On : BlockSkipSwitch::Off};
  if (arguments.trace)
    options.trace = std::ref(trace);
  const RunResult result = run(*programs.set, *start, options);
  std::vector<std::string> shown;
  for (const auto &file : programs.files)
    shown.push_back(file->shown);
  const RunReport report{*programs.set, shown, *start, result, trace.blocks};
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
  CLI::App *app = parent.add_subcommand("run", "execute a program: tool path, variables, alarms");
  const auto arguments = std::make_shared<RunArguments>();
  addOptions(*app, *arguments);
  return {app, [arguments] { return runOrComplain(*arguments); }};
}

} // namespace feedhold
