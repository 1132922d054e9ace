// offset-number-range: `G10 L2 P7`, `G10 L20 P0`, `G54.1 P0`, `H5000`; `G10 L12 P1` without R.
#include "rules/words/word_values.h"

#include "rules/flow/system_variables.h"
#include "rules/words/block_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace feedhold::rules::offset_number_range {
namespace {

constexpr std::uint32_t kWorkOffsets = 2;      // L of G54 to G59
constexpr std::uint32_t kMoreWorkOffsets = 20; // L of G54.1
constexpr std::uint32_t kLastWorkOffset = 6;   // P6: G59
constexpr std::uint32_t kLastMoreOffset = 300; // with the largest option
constexpr std::uint32_t kFirstToolTable = 10;  // L10 to L13: length, its wear, radius, its wear
constexpr std::uint32_t kLastToolTable = 13;

constexpr std::uint16_t kManyOffsetsOfHaas = 1540; // G154 P1 to P99
constexpr double kLastOfManyOffsets = 99;
constexpr double kMostOffsetPairs = 2000; // of FANUC controls, with the largest option
constexpr double kMostOfOthers = 999;
constexpr double kOffsetBound = 10000; // mm: offsets have four digits before the point

/// A word that numbers an offset, or is the value of one, and what it may be.
struct OffsetWord {
  const Word *table; // names the table
  AllowedNumbers allowed;
  std::string wrong; // "names no work offset"
  std::string range; // what the table has
};

double lastToolOffset(const FileContext &context) {
  if (context.dialect.hasFanucParameters)
    return kMostOffsetPairs;
  const OffsetMemory &memory = context.dialect.behaviour.lengthOffsets;
  return memory.count == 0 || memory.geometry[1] != 0 ? kMostOfOthers : memory.count;
}

OffsetWord toolOffset(const Word &table, double first, const FileContext &context) {
  const double last = lastToolOffset(context);
  return {&table, {first, last}, "names no tool offset", fmt::format("offsets {:g} to {:g}", first, last)};
}

std::optional<OffsetWord> ofDataSetting(const Word &word, BlockId block, const FileContext &context) {
  const Word *table = findWord(context.tree, block, 'L');
  const auto kind = table ? table->integer() : std::nullopt;
  if (!kind)
    return std::nullopt;
  const bool isTool = *kind >= kFirstToolTable && *kind <= kLastToolTable;
  if (word.address() == 'R')
    return isTool ? std::optional(OffsetWord{table,
                                             {std::nextafter(-kOffsetBound, 0), std::nextafter(kOffsetBound, 0)},
                                             "is beyond the range of a tool offset",
                                             "an offset has four digits before the point"})
                  : std::nullopt;
  if (*kind == kWorkOffsets)
    return OffsetWord{table, {0, kLastWorkOffset}, "names no work offset", "P1 to P6: G54 to G59"};
  if (*kind == kMoreWorkOffsets)
    return OffsetWord{table, {1, kLastMoreOffset}, "names no work offset", "P1 and up: G54.1 P1 and up"};
  if (isTool && context.dialect.machine == MachineKind::Milling)
    return toolOffset(*table, 1, context);
  return std::nullopt;
}

/// LinuxCNC, and grbl, whose programs have no O number, have P0 for the offset in force, P7 to P9, and Z for a tool.
bool isForOtherControl(BlockId block, const FileContext &context) {
  return context.dialect.grammar.oWords || !context.model.programs[context.model.programOf(block)].name.number;
}

std::optional<OffsetWord> offsetWordOf(const Word &word, BlockId block, const FileContext &context) {
  if (word.has(Word::kArgument) || word.has(Word::kComma) || context.tree.blocks[block].has(Block::kBroken) ||
      isForOtherControl(block, context))
    return std::nullopt;
  if (findCode(context.tree, block, context.dialect, CodeRole::DataSetting))
    return word.address() == 'P' || word.address() == 'R' ? ofDataSetting(word, block, context) : std::nullopt;
  if (context.tree.blocks[block].has(Block::kData) || meansOwnWords(context, block))
    return std::nullopt;
  if (word.address() == 'P') {
    const Word *code = findAction(context.tree, block, context.dialect, {CodeAction::ExtendedWorkOffset});
    if (!code)
      return std::nullopt;
    const double last = code->tenths() == kManyOffsetsOfHaas ? kLastOfManyOffsets : kLastMoreOffset;
    return OffsetWord{code, {1, last}, "names no work offset", fmt::format("P1 to P{:g}", last)};
  }
  const bool isNumber = (word.address() == 'H' || word.address() == 'D') &&
                        context.dialect.machine == MachineKind::Milling &&
                        !findCode(context.tree, block, context.dialect, CodeRole::CannedCycle) &&
                        !findCode(context.tree, block, context.dialect, CodeRole::Contour) &&
                        !findCode(context.tree, block, context.dialect, CodeRole::SubprogramCall);
  if (!isNumber)
    return std::nullopt;
  OffsetWord offset = toolOffset(word, 0, context);
  offset.allowed.least = -std::numeric_limits<double>::infinity(); // negative-number tells of a sign
  return offset;
}

std::vector<Label> labelOf(const OffsetWord &offset, const Word &word) {
  return offset.table == &word ? std::vector<Label>{} : std::vector<Label>{{offset.table->span(), offset.range}};
}

std::string consequence(const OffsetWord &offset, const Word &word) {
  if (offset.table == &word)
    return fmt::format("the control stops with an alarm: it has {} at most", offset.range);
  return offset.table->address() == 'L' ? "the control stops with an alarm, and the offset is not set"
                                        : "the control stops with an alarm";
}

/// A length of a tool without a point may be in the least increment.
bool isPlainValue(const Word &word) { return word.address() != 'R' || word.has(Word::kPoint); }

void checkLiteral(const Word &word, BlockId block, const FileContext &context, const Reporter &reporter) {
  if (!word.isNumber() || !isPlainValue(word) || hasTooManyWords(context, block))
    return;
  const auto offset = offsetWordOf(word, block, context);
  if (!offset || offset->allowed.contains(word.number().toDouble()))
    return;
  const std::string seen = offset->table == &word ? context.quoted(word.span())
                                                  : fmt::format("{} with {}", context.quoted(word.span()),
                                                                context.quoted(offset->table->span()));
  reporter.report({.message = fmt::format("{} {}", seen, offset->wrong),
                   .span = word.span(),
                   .labels = labelOf(*offset, word),
                   .notes = {consequence(*offset, word)}});
}

void checkComputed(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (const ComputedWord &computed : computedWordsOf(facts)) {
    const Word &word = *computed.word;
    const bool isAsked = std::string_view("DHPR").find(word.address()) != std::string_view::npos;
    const auto offset = isAsked ? offsetWordOf(word, computed.block, context) : std::nullopt;
    if (!offset)
      continue;
    AllowedNumbers allowed = offset->allowed;
    if (word.address() != 'R') { // whole numbers are rounded to the nearest
      allowed.least -= 0.5;
      allowed.most = std::nextafter(allowed.most + 0.5, 0);
    }
    const Outside outside = outsideOf(*computed.value, allowed);
    if (outside == Outside::Never)
      continue;
    Diagnostic diagnostic{.message = fmt::format("{} {}, which {}", context.quoted(word.span()),
                                                 describeNumber(*computed.value, allowed, outside), offset->wrong),
                          .span = word.span(),
                          .labels = labelOf(*offset, word),
                          .flow = pathOf(facts, computed, outside),
                          .notes = {consequence(*offset, word)}};
    reporter.report(std::move(diagnostic), outside == Outside::Always ? Severity::Error : Severity::Warning);
  }
}

/// `#2001=99999.`: PS0032 of FANUC controls, as at G10.
void checkVariable(const Assignment &assignment, NodeId node, const FlowFacts &facts, const FileContext &context,
                   const Reporter &reporter) {
  const auto number = variableOf(facts, assignment.target);
  const AbstractValue *value = facts.valueOf(assignment.value);
  if (!number || !value || !isToolOffset(context, *number))
    return;
  const AllowedNumbers allowed{std::nextafter(-kOffsetBound, 0), std::nextafter(kOffsetBound, 0)};
  const Outside outside = outsideOf(*value, allowed);
  if (outside == Outside::Never)
    return;
  const Span span = context.tree.expressions[assignment.value].span;
  const std::string seen = literalValue(context.tree, assignment.value)
                               ? fmt::format("{} is", context.quoted(span))
                               : fmt::format("{} {},", context.quoted(span), describeNumber(*value, allowed, outside));
  reporter.report({.message = fmt::format("{} beyond the range of a tool offset", seen),
                   .span = span,
                   .labels = {{context.tree.expressions[assignment.target].span, "the offset"}},
                   .flow = outside == Outside::Always ? pathFromEntry(facts, node) : std::vector<Label>{},
                   .notes = {"the control stops with PS0032 (offset value too large)"}},
                  outside == Outside::Always ? Severity::Error : Severity::Warning);
}

void checkFlow(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  checkComputed(facts, context, reporter);
  if (!context.dialect.hasFanucParameters)
    return;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    if (facts.isReached(node))
      for (const Assignment &assignment : assignmentsOf(facts, node))
        checkVariable(assignment, node, facts, context, reporter);
}

/// `G10 L12 P1`, or with Z in the place of R.
void checkValue(const Word &table, BlockId block, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Milling || findWord(context.tree, block, 'R'))
    return;
  const Word *axis = nullptr;
  for (const Word &word : context.tree.wordsOf(block))
    if (std::string_view("XYZ").find(word.address()) != std::string_view::npos)
      axis = &word;
  Diagnostic diagnostic{
      .message = fmt::format("{} sets a tool offset, but no R gives its value", context.quoted(table.span())),
      .span = table.span(),
      .notes = {"the offset stays as it is, or the control stops with an alarm", "write the value as R"}};
  if (axis)
    diagnostic.labels.push_back({axis->span(), "not the value of a tool offset"});
  reporter.report(std::move(diagnostic), Severity::Warning);
}

/// LinuxCNC refuses a P that is missing or beyond the table.  Source: the check of G10 in its interpreter.
void checkNgc(BlockId block, const FileContext &context, const Reporter &reporter) {
  constexpr std::uint32_t kToolTable = 1;
  constexpr std::uint32_t kLast = 9; // G59.3
  const Word *table = findWord(context.tree, block, 'L');
  const Word *number = findWord(context.tree, block, 'P');
  const auto kind = table ? table->integer() : std::nullopt;
  const bool isWork = kind == kWorkOffsets || kind == kMoreWorkOffsets;
  const bool isTool = kind == kToolTable || kind == kFirstToolTable || kind == kFirstToolTable + 1;
  if (!isWork && !isTool)
    return;
  const auto which = number ? number->integer() : std::nullopt;
  const bool isBeyond = which && ((isWork && *which > kLast) || (isTool && *which == 0));
  if (number && !isBeyond)
    return;
  const Word &shown = number ? *number : *table;
  reporter.report(
      {.message = number ? fmt::format("{} with {} names no {}", context.quoted(number->span()),
                                       context.quoted(table->span()), isWork ? "coordinate system" : "tool")
                         : fmt::format("{} needs a P", context.quoted(table->span())),
       .span = shown.span(),
       .notes = {"the interpreter stops with an error, and nothing is set",
                 isWork ? "write P1 for G54 to P9 for G59.3, or P0 for the one in force" : "write the tool as P"}});
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  const Word *table = findWord(context.tree, block, 'L');
  if (!table || !findCode(context.tree, block, context.dialect, CodeRole::DataSetting) ||
      context.tree.blocks[block].has(Block::kBroken))
    return;
  if (context.dialect.grammar.oWords)
    checkNgc(block, context, reporter);
  if (isForOtherControl(block, context))
    return;
  const auto kind = table->integer();
  if (!kind || *kind < kFirstToolTable || *kind > kLastToolTable || context.dialect.machine != MachineKind::Milling)
    return;
  if (findWord(context.tree, block, 'P'))
    return checkValue(*table, block, context, reporter);
  reporter.report({.message = fmt::format("{} sets a tool offset, but no P says which", context.quoted(table->span())),
                   .span = table->span(),
                   .notes = {"the control stops with an alarm", "write the number of the offset as P"}});
}

} // namespace

extern const Rule offsetNumberRange;
const Rule offsetNumberRange{
    .info =
        {"offset-number-range", Category::Word, Severity::Error,
         "Reports the number of a work offset or a tool offset that the control does not have, and a `G10` that gives "
         "a tool offset no value, or one beyond its range."},
    .hooks = {.block = check, .word = checkLiteral, .wordAddresses = "DHPR", .flow = checkFlow}};

} // namespace feedhold::rules::offset_number_range
