// Look-ups in the tables of a dialect.
#include "language/dialect/dialect.h"

#include "base/support/check.h"
#include "base/support/text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>

namespace feedhold {
namespace {

const Code *findCode(std::span<const Code> codes, std::uint16_t tenths) {
  const auto found = std::lower_bound(codes.begin(), codes.end(), tenths,
                                      [](const Code &code, std::uint16_t wanted) { return code.tenths < wanted; });
  return found != codes.end() && found->tenths == tenths ? &*found : nullptr;
}

} // namespace

const AddressFormat &formatOf(const Dialect &dialect, char address) {
  static constexpr AddressFormat kNone{};
  return isLetter(address) ? dialect.addresses[static_cast<std::size_t>(toUpper(address) - 'A')] : kNone;
}

bool hasModalCalls(const Dialect &dialect) {
  return std::ranges::any_of(dialect.gCodes, [](const Code &code) {
    return code.role == CodeRole::ModalCall || code.role == CodeRole::ModalCallEach;
  });
}

bool savesModes(const Dialect &dialect) {
  return std::ranges::any_of(dialect.mCodes,
                             [](const Code &code) { return code.action == CodeAction::ModesSaveForReturn; });
}

bool isBuildersCode(const Dialect &dialect, char address, std::uint16_t tenths) {
  const std::vector<CodeName> &codes = dialect.switches.buildersCodes;
  return !codes.empty() && std::find(codes.begin(), codes.end(), CodeName{address, tenths}) != codes.end();
}

const Code *findGCode(const Dialect &dialect, std::uint16_t tenths) {
  return isBuildersCode(dialect, 'G', tenths) ? nullptr : findCode(dialect.gCodes, tenths);
}

const Code *findMCode(const Dialect &dialect, std::uint16_t tenths) {
  return isBuildersCode(dialect, 'M', tenths) ? nullptr : findCode(dialect.mCodes, tenths);
}

bool hasGCode(const Dialect &dialect, std::uint16_t tenths) {
  return findGCode(dialect, tenths) || findCodeCall(dialect, 'G', tenths) || isBuildersCode(dialect, 'G', tenths);
}

bool mayDoAnything(const Dialect &dialect, char address, std::uint16_t tenths) {
  return (address == 'G' && !findGCode(dialect, tenths)) || (address == 'M' && isBuildersCode(dialect, 'M', tenths));
}

std::string textOf(const CodeName &name) {
  const std::string whole = name.address + std::to_string(name.tenths / 10);
  return name.tenths % 10 == 0 ? whole : whole + "." + std::to_string(name.tenths % 10);
}

std::optional<CodeName> codeNamed(std::string_view text, std::string_view addresses) {
  constexpr std::uint32_t kLastNumber = 6000; // as of a word
  const char address = text.empty() ? ' ' : toUpper(text.front());
  const std::string_view digits = text.substr(std::min<std::size_t>(1, text.size()));
  const std::string_view whole = digits.substr(0, digits.find('.'));
  const std::string_view tenth = whole.size() == digits.size() ? "0" : digits.substr(whole.size() + 1);
  const bool isNumber = !whole.empty() && whole.size() <= 4 && std::all_of(whole.begin(), whole.end(), isDigit) &&
                        tenth.size() == 1 && isDigit(tenth.front());
  if (addresses.find(address) == std::string_view::npos || !isNumber)
    return std::nullopt;
  std::uint32_t number = 0;
  for (const char c : whole)
    number = number * 10 + static_cast<std::uint32_t>(c - '0');
  if (number >= kLastNumber)
    return std::nullopt;
  return CodeName{address, static_cast<std::uint16_t>(number * 10 + static_cast<std::uint32_t>(tenth.front() - '0'))};
}

VariableRange buildersVariable(std::uint32_t first, std::uint32_t last) {
  return {.first = first,
          .last = last,
          .kind = VariableKind::System,
          .role = VariableRole::Volatile,
          .meaning = "variable of the machine builder"};
}

namespace {

/// `ranges` are sorted, without overlap.
const VariableRange *findIn(std::span<const VariableRange> ranges, std::uint32_t number) {
  const auto after =
      std::upper_bound(ranges.begin(), ranges.end(), number,
                       [](std::uint32_t wanted, const VariableRange &range) { return wanted < range.first; });
  if (after == ranges.begin())
    return nullptr;
  const VariableRange &range = *(after - 1);
  return number <= range.last ? &range : nullptr;
}

} // namespace

const VariableRange *rangeWithRole(const Dialect &dialect, VariableRole role) {
  const auto found = std::ranges::find(dialect.variables, role, &VariableRange::role);
  return found == dialect.variables.end() ? nullptr : &*found;
}

std::optional<std::uint32_t> workOffsetsBefore(const Dialect &dialect, std::uint16_t tenths) {
  const Code *code = findGCode(dialect, tenths);
  if (!code || code->action != CodeAction::WorkOffset)
    return std::nullopt;
  return static_cast<std::uint32_t>(std::ranges::count_if(
      dialect.gCodes, [&](const Code &each) { return each.action == CodeAction::WorkOffset && each.tenths < tenths; }));
}

const Code *additionalOffsetCode(const Dialect &dialect) {
  const Code *last = nullptr;
  for (const Code &code : dialect.gCodes)
    if (code.action == CodeAction::ExtendedWorkOffset && (!last || last->tenths < code.tenths))
      last = &code;
  return last;
}

std::optional<std::uint32_t> additionalOffsetOf(const Dialect &dialect, const Code &code) {
  if (code.action != CodeAction::ExtendedWorkOffset || code.tenths == additionalOffsetCode(dialect)->tenths)
    return std::nullopt;
  return 1 + static_cast<std::uint32_t>(std::ranges::count_if(dialect.gCodes, [&](const Code &each) {
           return each.action == CodeAction::ExtendedWorkOffset && each.tenths < code.tenths;
         }));
}

std::optional<std::uint32_t> additionalWorkOffset(const Dialect &dialect, std::uint32_t number) {
  struct Row {
    std::uint32_t first, most;
  };
  constexpr std::uint32_t kAxes = 9;
  constexpr Row kRows[] = {{7001, 48}, {14001, 300}}; // the second where the numbers from the first on are used up
  for (const auto &[first, most] : kRows) {
    if (number == 0 || number > most)
      continue;
    const std::uint32_t variable = first + kWorkOffsetStride * (number - 1);
    const VariableRange *range = findVariable(dialect, variable);
    if (range && range->role == VariableRole::AdditionalWorkOffset && variable + kAxes - 1 <= range->last)
      return cellOf(dialect, variable);
  }
  return std::nullopt;
}

const PredefinedName *findPredefinedName(const Dialect &dialect, std::uint32_t number) {
  const bool isOne = isPredefinedName(number) && number - kFirstPredefinedName < dialect.predefinedNames.size();
  return isOne ? &dialect.predefinedNames[number - kFirstPredefinedName] : nullptr;
}

std::optional<std::uint32_t> predefinedNamed(const Dialect &dialect, std::string_view name) {
  const auto nameOf = [](const PredefinedName &each) { return each.row.name; };
  const auto found = std::ranges::lower_bound(dialect.predefinedNames, name, {}, nameOf);
  return found != dialect.predefinedNames.end() && found->row.name == name ? std::optional(found->row.first)
                                                                           : std::nullopt;
}

const VariableRange *findVariable(const Dialect &dialect, std::uint32_t number) {
  if (const PredefinedName *name = findPredefinedName(dialect, number))
    return &name->row;
  const VariableRange *range = findIn(dialect.variables, number);
  return range ? range : findIn(dialect.switches.buildersVariables, number);
}

namespace {

/// On: the cells are the same.
Switch isSame(const Dialect &dialect, const CellAlias &alias) {
  const Switch v15 = dialect.switches.v15;
  switch (alias.when) {
  case AliasWhen::Always: return Switch::On;
  case AliasWhen::Perhaps: return Switch::Unknown;
  case AliasWhen::WithV15: return v15;
  case AliasWhen::WithoutV15: return v15 == Switch::Unknown ? v15 : v15 == Switch::On ? Switch::Off : Switch::On;
  }
  return Switch::Unknown;
}

/// All cells that the row names.
VariableSpan cellsOf(const CellAlias &alias) {
  const std::uint32_t rows = (alias.last - alias.first) / alias.period;
  return {alias.cell, alias.cell + rows * alias.rowStep + (alias.width - 1) * alias.columnStep};
}

bool meets(VariableSpan a, VariableSpan b) { return a.first <= b.last && b.first <= a.last; }

} // namespace

std::uint32_t cellOf(const Dialect &dialect, std::uint32_t number) {
  if (const PredefinedName *name = findPredefinedName(dialect, number))
    return name->source == NameSource::Variable ? name->detail : number;
  for (const CellAlias &alias : dialect.aliases)
    if (isSame(dialect, alias) == Switch::On)
      if (const auto cell = alias.cellOf(number))
        return *cell;
  return number;
}

std::vector<std::uint32_t> perhapsSameAs(const Dialect &dialect, std::uint32_t cell) {
  std::vector<std::uint32_t> others;
  for (const CellAlias &alias : dialect.aliases) {
    if (isSame(dialect, alias) != Switch::Unknown)
      continue;
    if (const auto other = alias.cellOf(cell))
      others.push_back(cellOf(dialect, *other));
    if (const VariableSpan cells = cellsOf(alias); cells.first <= cell && cell <= cells.last)
      for (std::uint32_t number = alias.first; number <= alias.last; ++number)
        if (alias.cellOf(number) == cell)
          others.push_back(cellOf(dialect, number));
  }
  return others;
}

bool isVolatile(VariableRole role) {
  return role == VariableRole::Volatile || role == VariableRole::Signal || role == VariableRole::SignalWord ||
         role == VariableRole::Clock;
}

/// States of the control without a row of their own are not known to change in a run.
bool mayRead(const VariableRange &range, std::span<const double> readings) {
  constexpr double kMostOfWord = 2147483647; // 31 bits: what the last of 32 counts for, manuals tell in two ways
  const auto all = [&](auto holds) { return std::all_of(readings.begin(), readings.end(), holds); };
  if (range.role == VariableRole::Signal)
    return all([](double number) { return number == 0 || number == 1; });
  if (range.role == VariableRole::SignalWord)
    return all([](double number) { return number >= 0 && number <= kMostOfWord && std::floor(number) == number; });
  if (range.role == VariableRole::Clock)
    return all([](double number) { return number >= 0; }) && std::is_sorted(readings.begin(), readings.end());
  return range.role == VariableRole::Volatile && all([&](double number) { return number == readings.front(); });
}

const BitWord *findBitWord(const Dialect &dialect, std::uint32_t number) {
  const auto found = std::find_if(dialect.bitWords.begin(), dialect.bitWords.end(),
                                  [number](const BitWord &row) { return row.word == number; });
  return found != dialect.bitWords.end() ? &*found : nullptr;
}

std::vector<VariableSpan> cellsBeside(const Dialect &dialect, std::uint32_t first, std::uint32_t last) {
  std::vector<VariableSpan> beside;
  for (const CellAlias &alias : dialect.aliases) {
    const Switch same = isSame(dialect, alias);
    if (same != Switch::Off && meets({first, last}, {alias.first, alias.last}))
      beside.push_back(cellsOf(alias));
    if (same == Switch::Unknown && meets({first, last}, cellsOf(alias)))
      beside.push_back({alias.first, alias.last});
  }
  for (const BitWord &row : dialect.bitWords)
    if (first <= row.word && row.word <= last)
      beside.push_back({row.firstBit, row.firstBit + row.bits - 1});
  return beside;
}

const Function *findFunction(const Dialect &dialect, FunctionKind kind) {
  const auto found = std::find_if(dialect.functions.begin(), dialect.functions.end(),
                                  [kind](const Function &function) { return function.kind == kind; });
  return found != dialect.functions.end() ? &*found : nullptr;
}

int precedenceOf(const Dialect &dialect, OperatorKind op) {
  const auto found = std::find_if(dialect.operators.begin(), dialect.operators.end(),
                                  [op](const Operator &row) { return row.kind == op; });
  return found != dialect.operators.end() ? found->precedence : 0;
}

bool raisesAlarm(const Dialect &dialect, std::uint32_t number) {
  const VariableRange *range = findVariable(dialect, number);
  return range != nullptr && range->role == VariableRole::Alarm;
}

std::string_view nameOf(NumberModel model) {
  switch (model) {
  case NumberModel::Binary64: return "binary64";
  case NumberModel::Mantissa32: return "mantissa32";
  case NumberModel::Either: return "either";
  }
  FEEDHOLD_UNREACHABLE("the switch names every model");
}

std::span<const std::string_view> incrementSystemNames() {
  static constexpr std::array<std::string_view, 3> kNames = {"IS-A", "IS-B", "IS-C"};
  return kNames;
}

std::string_view nameOf(IncrementSystem system) { return incrementSystemNames()[static_cast<std::size_t>(system)]; }

std::optional<IncrementSystem> incrementSystemNamed(std::string_view name) {
  const auto names = incrementSystemNames();
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? std::nullopt : std::optional(static_cast<IncrementSystem>(found - names.begin()));
}

std::span<const std::string_view> gCodeSystemNames() {
  static constexpr std::array<std::string_view, kGCodeSystems> kNames = {"A", "B", "C"};
  return kNames;
}

std::string_view nameOf(GCodeSystem system) { return gCodeSystemNames()[static_cast<std::size_t>(system)]; }

std::optional<GCodeSystem> gCodeSystemNamed(std::string_view name) {
  const auto names = gCodeSystemNames();
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? std::nullopt : std::optional(static_cast<GCodeSystem>(found - names.begin()));
}

void chooseGCodeSystem(Dialect &dialect, GCodeSystem system) {
  const std::span<const Code> codes = dialect.gCodesOfSystem[static_cast<std::size_t>(system)];
  if (codes.empty())
    return;
  dialect.switches.gCodeSystem = system;
  dialect.gCodes = codes;
}

LeastIncrements leastIncrementsOf(const Dialect &dialect) {
  switch (dialect.switches.incrementSystem) {
  case IncrementSystem::A: return {Decimal(1, 2), Decimal(1, 3)};
  case IncrementSystem::B: return {Decimal(1, 3), Decimal(1, 4)};
  case IncrementSystem::C: return {Decimal(1, 4), Decimal(1, 5)};
  }
  FEEDHOLD_UNREACHABLE("the switch has a row for every increment system");
}

NumberModel numbersOf(const Dialect &dialect) {
  return dialect.switches.f16 == Switch::On ? NumberModel::Mantissa32 : dialect.numbers;
}

NumberModel numbersOfRun(const Dialect &dialect) {
  const NumberModel numbers = numbersOf(dialect);
  return numbers == NumberModel::Either ? NumberModel::Binary64 : numbers;
}

std::string_view meaningOf(AlarmKind kind) {
  static constexpr std::string_view kMeanings[] = {
#define ALARM(kind, meaning) meaning,
#include "language/dialect/alarms.def"
  };
  return kMeanings[static_cast<std::size_t>(kind)];
}

std::optional<std::string_view> alarmNumber(const Dialect &dialect, AlarmKind kind) {
  const auto found = std::find_if(dialect.alarms.begin(), dialect.alarms.end(),
                                  [kind](const AlarmNumber &row) { return row.kind == kind; });
  if (found == dialect.alarms.end())
    return std::nullopt;
  return found->number;
}

std::string stopsWith(const Dialect &dialect, AlarmKind kind) {
  if (const std::optional<std::string_view> number = alarmNumber(dialect, kind))
    return fmt::format("stops with {} ({})", *number, meaningOf(kind));
  return fmt::format("stops with an alarm ({})", meaningOf(kind));
}

const CodeCall *findCodeCall(const Dialect &dialect, char address, std::uint16_t tenths) {
  for (const CodeCall &call : dialect.switches.codeCalls)
    if (call.address == address && call.tenths == tenths)
      return &call;
  return nullptr;
}

bool callsMacro(const Dialect &dialect, char address, std::uint16_t tenths) {
  const Code *code = address == 'G'   ? findGCode(dialect, tenths)
                     : address == 'M' ? findMCode(dialect, tenths)
                                      : nullptr;
  if (code &&
      (code->role == CodeRole::MacroCall || code->role == CodeRole::ModalCall || code->role == CodeRole::ModalCallEach))
    return true;
  const CodeCall *call = findCodeCall(dialect, address, tenths);
  return call && call->isMacro;
}

std::uint8_t argumentVariable(const Dialect &dialect, char address) {
  return address >= 'A' && address <= 'Z' ? dialect.argumentVariables[static_cast<std::size_t>(address - 'A')]
                                          : std::uint8_t{0};
}

} // namespace feedhold
