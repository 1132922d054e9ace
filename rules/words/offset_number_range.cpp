// offset-number-range: `G10 L2 P7`, `G10 L20 P0`; `G10 L12 P1` without R.
#include "findings/rule/rule.h"

#include <fmt/format.h>

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

void tellRange(const Word &number, const Word &table, std::string_view range, const FileContext &context,
               const Reporter &reporter) {
  reporter.report({.message = fmt::format("{} with {} names no work offset", context.quoted(number.span()),
                                          context.quoted(table.span())),
                   .span = number.span(),
                   .labels = {{table.span(), std::string(range)}},
                   .notes = {"the control stops with an alarm, and the offset is not set"}});
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

/// LinuxCNC, and grbl, whose programs have no O number, have P0 for the offset in force, P7 to P9, and Z for a tool.
bool isForOtherControl(BlockId block, const FileContext &context) {
  return context.dialect.grammar.oWords || !context.model.programs[context.model.programOf(block)].name.number;
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
  const Word *number = findWord(context.tree, block, 'P');
  const auto kind = table->integer();
  if (!kind || !number)
    return;
  const auto which = number->integer();
  if (*kind == kWorkOffsets && which && *which > kLastWorkOffset)
    tellRange(*number, *table, "P1 to P6: G54 to G59", context, reporter);
  else if (*kind == kMoreWorkOffsets && which && (*which == 0 || *which > kLastMoreOffset))
    tellRange(*number, *table, "P1 and up: G54.1 P1 and up", context, reporter);
  else if (*kind >= kFirstToolTable && *kind <= kLastToolTable)
    checkValue(*table, block, context, reporter);
}

} // namespace

extern const Rule offsetNumberRange;
const Rule offsetNumberRange{
    .info = {"offset-number-range", Category::Word, Severity::Error,
             "Reports a `G10` whose P names no work offset, or that gives a tool offset no value."},
    .hooks = {.block = check}};

} // namespace feedhold::rules::offset_number_range
