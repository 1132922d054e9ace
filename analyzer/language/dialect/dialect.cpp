// Look-ups in the tables of a dialect.
#include "language/dialect/dialect.h"

#include "base/support/text.h"

#include <algorithm>
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

const Code *findGCode(const Dialect &dialect, std::uint16_t tenths) { return findCode(dialect.gCodes, tenths); }

const Code *findMCode(const Dialect &dialect, std::uint16_t tenths) { return findCode(dialect.mCodes, tenths); }

const VariableRange *findVariable(const Dialect &dialect, std::uint32_t number) {
  const auto after =
      std::upper_bound(dialect.variables.begin(), dialect.variables.end(), number,
                       [](std::uint32_t wanted, const VariableRange &range) { return wanted < range.first; });
  if (after == dialect.variables.begin())
    return nullptr;
  const VariableRange &range = *(after - 1);
  return number <= range.last ? &range : nullptr;
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

} // namespace feedhold
