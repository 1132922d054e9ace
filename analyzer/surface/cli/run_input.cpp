#include "surface/cli/run_input.h"

#include "base/support/text.h"
#include "dialects/registry.h"
#include "language/dialect/switch_names.h"
#include "language/syntax/tree.h"
#include "proof/space/plain_space.h"
#include "rules/registry.h"
#include "surface/cli/terminal.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <sstream>

namespace feedhold {

namespace {

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
    return Error{fmt::format("`{}` is not of the form NAME=VALUE", text)};
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

/// The machine or the clock changes it: a program that reads it twice may find two numbers.
bool isInput(const Dialect &dialect, std::uint32_t variable) {
  const VariableRange *range = findVariable(dialect, cellOf(dialect, variable));
  return range && range->kind == VariableKind::System && isVolatile(range->role) &&
         range->access != VariableAccess::WriteOnly;
}

/// `#1000=0,0,1`
std::optional<Error> addReadings(const std::string &text, const Project &programs, GivenVariables &given) {
  const std::size_t equals = text.rfind('='); // names may have one
  std::vector<double> script;
  for (std::size_t at = equals; at < text.size();) {
    const std::size_t comma = text.find(',', at + 1);
    const auto number = numberFrom(trimmed(std::string_view(text).substr(at + 1, comma - at - 1)));
    if (!number)
      return Error{fmt::format("--input: `{}` is not of the form #1000=0,0,1", text)};
    script.push_back(*number);
    at = comma;
  }
  if (script.empty())
    return Error{fmt::format("--input: `{}` is not of the form #1000=0,0,1", text)};
  const std::string_view name = trimmed(std::string_view(text).substr(0, equals));
  if (name == "skip") {
    if (!std::ranges::all_of(script, [](double share) { return 0 <= share && share <= 1; }))
      return Error{fmt::format("--input: `{}` is not of the form skip=0.5,1: shares of the way, from 0 to 1", text)};
    given.readings.set(kSkipShare, std::move(script));
    return std::nullopt;
  }
  const auto variable = variableFrom(*programs.set, name);
  const bool isNamed = variable && isReadByName(*programs.set, programs.dialect(), *variable);
  if (!variable || (!isNamed && (*variable >= kFirstNamedVariable || !isInput(programs.dialect(), *variable))))
    return Error{
        fmt::format("--input: `{}` is not an input or a clock of this control; use --var to set any variable", name)};
  given.readings.set(*variable, std::move(script));
  return std::nullopt;
}

/// The variables of an offset register: by its letter, as offset pages show it.
struct OffsetVariables {
  std::uint32_t first = 0;
  std::uint32_t count = 0; // 0: the control keeps none in variables
};
/// Absent: no such register.
std::optional<OffsetVariables> offsetVariables(const Dialect &dialect, char letter) {
  const auto &[radius, tip] = dialect.behaviour.noseOffsets;
  const OffsetMemory &cutter = dialect.behaviour.cutterOffsets;
  const bool isLathe = dialect.machine == MachineKind::Turning;
  if (isLathe && letter == 'R')
    return OffsetVariables{radius.geometry.front(), radius.count};
  if (isLathe && letter == 'T')
    return OffsetVariables{tip.front(), radius.count};
  return !isLathe && letter == 'D' ? std::optional(OffsetVariables{cutter.geometry.front(), cutter.count})
                                   : std::nullopt;
}

/// `D1=5.`: what the register of the cutter offset holds.  Of a lathe `R1=.8` and `T1=3`, the nose of its offset 1.
std::optional<Error> addOffset(const std::string &text, const Project &programs, GivenVariables &given) {
  const Dialect &dialect = programs.dialect();
  const Result<Setting> setting = settingFrom(text);
  const std::string name = setting ? setting.value().name : "";
  const auto number = name.size() > 1 ? numberFrom(std::string_view(name).substr(1)) : std::nullopt;
  const auto offsets = number ? offsetVariables(dialect, toUpper(name.front())) : std::nullopt;
  if (!offsets)
    return Error{fmt::format("--offset: `{}` is not of the form {}", text,
                             dialect.machine == MachineKind::Turning ? "R1=0.8 or T1=3" : "D1=5")};
  if (offsets->count == 0)
    return Error{fmt::format("--offset: `{}`: this control keeps no cutter offsets in variables", text)};
  if (*number != std::floor(*number) || *number < 1 || *number > offsets->count)
    return Error{fmt::format("--offset: `{0}`: this control has the offsets {1}1 to {1}{2}", text,
                             toUpper(name.front()), offsets->count)};
  const std::uint32_t variable = offsets->first + static_cast<std::uint32_t>(*number) - 1;
  given.set(cellOf(dialect, variable), ConcreteValue::of(setting.value().value));
  return std::nullopt;
}

Result<GivenVariables> givenVariables(const RunInput &input, const Project &programs) {
  GivenVariables given;
  for (const std::string &text : input.arguments) {
    const Result<Setting> setting = settingFrom(text);
    if (!setting)
      return Error{"--arg: " + setting.error().message};
    const auto variable = argumentVariable(programs.dialect(), setting.value().name);
    if (!variable)
      return Error{fmt::format("--arg: `{}` is not an argument letter of this control; use --var to set any variable",
                               setting.value().name)};
    given.set(*variable, ConcreteValue::of(setting.value().value));
  }
  for (const std::string &text : input.variables) {
    const Result<Setting> setting = settingFrom(text);
    if (!setting)
      return Error{"--var: " + setting.error().message};
    const auto variable = variableFrom(*programs.set, setting.value().name);
    if (!variable)
      return Error{fmt::format("--var: no program has a variable `{}`", setting.value().name)};
    given.set(*variable, ConcreteValue::of(setting.value().value));
  }
  for (const std::string &text : input.offsets)
    if (auto complaint = addOffset(text, programs, given))
      return *std::move(complaint);
  for (const std::string &text : input.readings)
    if (auto complaint = addReadings(text, programs, given))
      return *std::move(complaint);
  return given;
}

/// The words of all uses of an option: `--start X0 Y0` and `--start "X0 Y0"`.
std::vector<std::string> wordsOf(const std::vector<std::string> &texts) {
  std::istringstream words(fmt::format("{}", fmt::join(texts, " ")));
  return {std::istream_iterator<std::string>(words), {}};
}

std::optional<Error> addPlace(const RunInput &input, GivenStart &start) {
  for (const std::string &word : wordsOf(input.start)) {
    const auto axis = axisOf(toUpper(word.front()));
    const auto value = axis ? numberFrom(std::string_view(word).substr(1)) : std::nullopt;
    if (!value)
      return Error{fmt::format("--start: `{}` is not a coordinate such as X10.5", word)};
    start.place.emplace_back(*axis, *value);
  }
  return std::nullopt;
}

/// `G18` or `T5`
std::optional<Error> addModal(const std::string &word, const Dialect &dialect, GivenStart &start) {
  const char letter = toUpper(word.front());
  const auto number = numberFrom(std::string_view(word).substr(1));
  const bool isWord = kGivenWords.find(letter) != std::string_view::npos;
  if (number && isWord) {
    start.words.emplace_back(letter, *number);
    return std::nullopt;
  }
  const double tenths = number ? *number * 10 : 0;
  const bool isCode =
      number && letter == 'G' && tenths >= 0 && tenths < 10'000 && std::fabs(tenths - std::round(tenths)) < 1e-6;
  const Code *code = isCode ? findGCode(dialect, static_cast<std::uint16_t>(std::round(tenths))) : nullptr;
  const ModalTable modes(dialect);
  const auto index = code && isWholeMode(code->action) ? modes.indexOf(*code) : std::nullopt;
  if (!index)
    return Error{
        fmt::format("--modal: `{}` cannot be in force at the start: use modal codes without words of their own, "
                    "such as G18 or G91, and T, D, H, F or S with a number",
                    word)};
  start.codes.emplace_back(code->group, *index);
  return std::nullopt;
}

std::optional<Error> addStart(const RunInput &input, const Dialect &dialect, GivenStart &start) {
  if (auto complaint = addPlace(input, start))
    return complaint;
  for (const std::string &word : wordsOf(input.modal))
    if (auto complaint = addModal(word, dialect, start))
      return complaint;
  return std::nullopt;
}

NumberModel numbersFor(const RunInput &input, const Dialect &dialect) {
  if (input.numbers.empty())
    return numbersOfRun(dialect);
  return input.numbers == nameOf(NumberModel::Mantissa32) ? NumberModel::Mantissa32 : NumberModel::Binary64;
}

/// `cir=on`
Result<SwitchSetting> switchFrom(const std::string &text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  const auto setting = switchNamed(std::string_view(text).substr(0, equals));
  const std::string_view value = std::string_view(text).substr(std::min(equals + 1, text.size()));
  if (!setting || (value != "on" && value != "off"))
    return Error{fmt::format("--switch: `{}` is not a setting and its value, such as bare_cycle_stops=on", text)};
  return SwitchSetting{switchNames()[*setting].which, value == "on" ? Switch::On : Switch::Off};
}

Result<std::unique_ptr<const Project>> load(const RunInput &input) {
  ProgramOptions options{.path = input.path};
  if (input.path == "-")
    options.piped = PipedText{"<stdin>", readStandardInput()};
  if (const auto complaint = complaintAbout(input.control))
    return Error{*complaint};
  options.control = controlFrom(input.control);
  for (const std::string &text : input.switches) {
    const auto setting = switchFrom(text);
    if (!setting)
      return setting.error();
    options.control.switches.push_back(setting.value());
  }
  options.config = configFrom(input.config);
  return loadProject(options, {allDialects(), allRules()});
}

} // namespace

void addRunInput(CLI::App &app, RunInput &input) {
  app.add_option("file", input.path, "program file; called programs are found in its folder; - is standard input")
      ->type_name("FILE")
      ->required();
  app.add_option("--program", input.program, "program of the file to start (default: the first)")->type_name("PROGRAM");
  app.add_option("--arg", input.arguments, "pass an argument, as a macro call does: A=10 (may be repeated)")
      ->type_name("LETTER=VALUE")
      ->allow_extra_args(false);
  app.add_option("--var", input.variables, "set a variable at the start: 500=3 or <depth>=2.5 (may be repeated)")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  app.add_option(
         "--offset", input.offsets,
         "what the register of an offset holds for G41 and G42: D1=5; of a lathe R1=0.8 and T1=3 (may be repeated)")
      ->type_name("REGISTER=VALUE")
      ->allow_extra_args(false);
  app.add_option(
         "--input", input.readings,
         "numbers that the reads of an input give in order; the last stays: \"#1000=0,0,1\"; skip=0.5: the share of "
         "its way after which the signal of a G31 comes (may be repeated)")
      ->type_name("NAME=VALUES")
      ->allow_extra_args(false);
  app.add_option("--start", input.start, "position of the tool at the start: X0 Y0 Z5")->type_name("POSITION");
  app.add_option("--modal", input.modal, "modal codes and words in force at the start: G18 G91 T5")->type_name("WORDS");
  app.add_option("--switch", input.switches,
                 "a setting of the machine, as in feedhold.toml: bare_cycle_stops=on (may be repeated)")
      ->type_name("NAME=on|off")
      ->allow_extra_args(false);
  app.add_option("--fuel", input.fuel,
                 fmt::format("stop after this many instructions (default: {})", RunOptions{}.fuel))
      ->type_name("N")
      ->check(CLI::PositiveNumber);
  app.add_flag("--block-skip", input.blockSkip, "turn the block skip switch on");
  app.add_option("--numbers", input.numbers,
                 "numbers of the control: binary64 (doubles) or mantissa32 (default: those of the dialect)")
      ->type_name("MODEL")
      ->check(CLI::IsMember({nameOf(NumberModel::Binary64), nameOf(NumberModel::Mantissa32)}));
  app.add_option("--missing", input.missing,
                 "what a call of a program that is in none of the files does: the control stops with an alarm, or the "
                 "program returns and changes nothing")
      ->check(CLI::IsMember({"stop", "return"}))
      ->capture_default_str();
  addControl(app, input.control);
  addConfiguration(app, input.config);
}

Result<PreparedRun> prepareRun(const RunInput &input) {
  auto loaded = load(input);
  if (!loaded)
    return loaded.error();
  const Project &programs = *loaded.value();
  const auto name = input.program.empty() ? std::nullopt : std::optional(input.program);
  const std::optional<Callee> start = startOf(programs, name);
  if (!start)
    return Error{name ? fmt::format("{}: contains no program `{}`", input.path, *name)
                      : fmt::format("{}: contains no program", input.path)};
  Result<GivenVariables> variables = givenVariables(input, programs);
  if (!variables)
    return variables.error();
  GivenVariables given = variables.take();
  if (const auto complaint = addStart(input, *programs.file(start->file).dialect, given.start))
    return *complaint;
  RunOptions options{.variables = std::move(given),
                     .fuel = input.fuel,
                     .blockSkip = input.blockSkip ? BlockSkipSwitch::On : BlockSkipSwitch::Off,
                     .numbers = numbersFor(input, *programs.file(start->file).dialect),
                     .missing = input.missing == "return" ? MissingPrograms::Return : MissingPrograms::Stop};
  options = prove::startedAsSaid(*programs.set, *start, programs.file(start->file).contracts, std::move(options));
  options = prove::followedAsSaid(*programs.set, *start, &programs.file(start->file).contracts, std::move(options));
  return PreparedRun{loaded.take(), *start, std::move(options)};
}

} // namespace feedhold
