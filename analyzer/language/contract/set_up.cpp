// The clauses of the set-up: work offsets, tool lengths, the range and the reference position of the machine, how it
// rounds corners, and the axes of `@FIXED`.
#include "language/contract/clauses.h"

#include <fmt/format.h>

#include <optional>

namespace feedhold {

namespace {

constexpr std::string_view kOffsetAxes = "XYZABCUVW"; // in the order of their variables
std::uint32_t indexOfAxis(char letter) { return static_cast<std::uint32_t>(kOffsetAxes.find(letter)); }

/// `G54.1 P3`, or `G110` alone; absent: the clause has an issue.
std::optional<std::uint32_t> firstOfAdditional(ClauseReader &reader, const ContractReading &reading, const Code &code) {
  if (const auto own = additionalOffsetOf(reading.dialect, code))
    return additionalWorkOffset(reading.dialect, *own);
  const Span span = reader.ahead();
  if (!reader.takeAddress('P')) {
    reader.expected("`P` and the number of the additional work offset, such as `P1`");
    return std::nullopt;
  }
  const std::uint32_t number = reader.integer("the number of the additional work offset");
  const auto first = additionalWorkOffset(reading.dialect, number);
  if (!reader.failed() && !first)
    reader.fail(ContractIssueKind::Code, span, "this control has no additional work offset of this number");
  return first;
}

/// The variable of the external work offset's X, or of the one that a code chooses; absent: the clause has an issue.
std::optional<std::uint32_t> firstOfWorkOffset(ClauseReader &reader, const ContractReading &reading) {
  if (reader.take("EXT")) {
    const VariableRange *external = findVariable(reading.dialect, kFirstWorkOffset);
    if (external && external->role == VariableRole::WorkOffset)
      return kFirstWorkOffset;
    reader.expected("a work offset such as `G54`; this control has no external one");
    return std::nullopt;
  }
  const Span span = reader.ahead();
  reader.takeLetter("G");
  const ExpressionId number = reader.value("the number of the code, such as `G54`");
  const std::optional<Decimal> value = literalValue(reading.result.tree, number);
  const auto tenths = value ? Word::number('G', *value, span, 0).tenths() : std::nullopt;
  const Code *code = tenths ? findGCode(reading.dialect, *tenths) : nullptr;
  if (!reader.failed() && code && code->action == CodeAction::ExtendedWorkOffset)
    return firstOfAdditional(reader, reading, *code);
  const std::optional<std::uint32_t> before = tenths ? workOffsetsBefore(reading.dialect, *tenths) : std::nullopt;
  if (!reader.failed() && !before)
    reader.fail(ContractIssueKind::Code, span, "it is none of the work offsets of this control from G54 on");
  return before ? std::optional(kFirstWorkOffset + kWorkOffsetStride * (*before + 1)) : std::nullopt;
}

} // namespace

std::vector<SetUpValue> readWorkOffset(ClauseReader &reader, const ContractReading &reading) {
  std::vector<SetUpValue> values;
  const std::optional<std::uint32_t> first = firstOfWorkOffset(reader, reading);
  while (const std::optional<char> letter = first ? reader.takeLetter(kOffsetAxes) : std::nullopt) {
    const Range range =
        reader.valueOrRange(fmt::format("where {0} of the zero point lies, such as `{0}-400..-300`", *letter));
    if (reader.failed())
      return {};
    values.push_back({*first + indexOfAxis(*letter), range});
  }
  if (first && values.empty())
    reader.expected("axes with machine coordinates, such as `X-400..-300 Z-350.`");
  return values;
}

LengthRange readLength(ClauseReader &reader, const ContractReading &reading, ClauseId clause) {
  LengthRange length{clause, {}, {}};
  const std::uint32_t most = reading.dialect.behaviour.lengthOffsets.count;
  const Span span = reader.ahead();
  if (most == 0)
    reader.fail(ContractIssueKind::Code, span, "this control keeps no tool lengths in variables");
  else if (!reader.takeAddress('H'))
    reader.expected("`H` and its number, such as `H1`, or `H*` for any");
  else if (!reader.takeSign('*'))
    length.number = reader.integer("the number of H, or `*` for any");
  if (!reader.failed() && length.number && (*length.number < 1 || *length.number > most))
    reader.fail(ContractIssueKind::Code, span, fmt::format("this control has H1 to H{}", most));
  length.length = reader.valueOrRange("the length, such as `120.` or `50..200`");
  if (!reader.failed() && !length.length.low && !length.length.high)
    reader.expected("an end of the range of the length");
  return length;
}

std::optional<Decimal> readStep(ClauseReader &reader, const ContractReading &reading) {
  const Span span = reader.ahead();
  constexpr std::string_view kExpected = "a step from 0.0001 to 1, such as `0.001`";
  const ExpressionId number = reader.value(kExpected);
  const auto step = reader.failed() ? std::nullopt : literalValue(reading.result.tree, number);
  if (!step || *step < Decimal(1, 4) || *step > Decimal::fromInteger(1))
    reader.fail(ContractIssueKind::Malformed, span, std::string(kExpected));
  return step;
}

std::optional<CornerRounding> readCorner(ClauseReader &reader, const ContractReading &reading, ClauseId clause) {
  constexpr std::string_view kExpected = "how far the tool leaves the path at corners: a number from 0, such as `0.05`";
  const Span span = reader.ahead();
  const ExpressionId number = reader.value(kExpected);
  const auto most = reader.failed() ? std::nullopt : literalValue(reading.result.tree, number);
  if (!most || *most < Decimal::fromInteger(0))
    reader.fail(ContractIssueKind::Malformed, span, std::string(kExpected));
  return most ? std::optional(CornerRounding{clause, *most}) : std::nullopt;
}

FixedAxes readFixed(ClauseReader &reader, ClauseId clause) {
  FixedAxes fixed{clause, {}};
  while (const std::optional<char> letter = reader.takeLetter("ABC")) {
    if (fixed.axes.find(*letter) == std::string::npos)
      fixed.axes += *letter;
  }
  if (fixed.axes.empty())
    reader.expected("rotary axes, such as `A` or `B C`");
  return fixed;
}

std::vector<SetUpValue> readHome(ClauseReader &reader, const ContractReading &reading) {
  const Span span = reader.ahead();
  const std::vector<AxisValue> axes = readAxisValues(reader, kOffsetAxes);
  if (axes.empty())
    reader.expected("the machine coordinates of the reference position, such as `X0 Y0 Z0`");
  const VariableRange *range = rangeWithRole(reading.dialect, VariableRole::Reference);
  std::vector<SetUpValue> home;
  for (const AxisValue &each : axes) {
    const std::optional<Decimal> value = literalValue(reading.result.tree, each.value);
    if (range)
      home.push_back({range->first + indexOfAxis(each.axis), ValueList{{each.value}}});
    else if (!reader.failed() && (!value || !value->isZero()))
      reader.fail(ContractIssueKind::Malformed, span, "0 for each axis: G28 of this control returns to machine zero");
  }
  return home;
}

bool isOfSetUp(ClauseKind kind) {
  return kind == ClauseKind::Offset || kind == ClauseKind::Length || kind == ClauseKind::Machine ||
         kind == ClauseKind::Corner;
}

} // namespace feedhold
