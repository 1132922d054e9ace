// offset-of-other-table: `G10 L20 P1 X0` in a program that works in G54: P1 is that of `G54.1 P1`.
#include "findings/rule/rule.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::offset_of_other_table {
namespace {

constexpr std::uint32_t kAdditional = 20; // L of the table of additional work offsets
constexpr std::uint32_t kFirstTable = 6;  // G54 to G59

const Word *codeThat(BlockId block, const FileContext &context, std::initializer_list<CodeAction> actions) {
  return findAction(context.tree, block, context.dialect, actions);
}

bool uses(const FileContext &context, std::initializer_list<CodeAction> actions) {
  for (BlockId block(0); block.index() < context.tree.blockCount(); block = block.next())
    if (codeThat(block, context, actions))
      return true;
  return false;
}

void check(const FileContext &context, const Reporter &reporter) {
  if (context.dialect.grammar.oWords || uses(context, {CodeAction::ExtendedWorkOffset}) ||
      !uses(context, {CodeAction::WorkOffset}))
    return;
  for (BlockId block(0); block.index() < context.tree.blockCount(); block = block.next()) {
    if (!findCode(context.tree, block, context.dialect, CodeRole::DataSetting))
      continue;
    const Word *table = findWord(context.tree, block, 'L');
    const Word *number = findWord(context.tree, block, 'P');
    const auto which = number ? number->integer() : std::nullopt;
    if (!table || table->integer() != kAdditional || !which || *which < 1 || *which > kFirstTable)
      continue;
    reporter.report({.message = fmt::format("{} sets an additional work offset, which no block of this file uses",
                                            context.quoted(table->span())),
                     .span = table->span(),
                     .labels = {{number->span(), fmt::format("not that of G{}", 53 + *which)}},
                     .notes = {fmt::format("`L2 P{}` sets G{}; `L20 P{}` belongs to `G54.1 P{}`", *which, 53 + *which,
                                           *which, *which),
                               "on LinuxCNC and grbl, `L20 P1` sets G54 from the present position"}});
  }
}

} // namespace

extern const Rule offsetOfOtherTable;
const Rule offsetOfOtherTable{
    .info = {"offset-of-other-table", Category::Motion, Severity::Warning,
             "Reports `G10 L20 P1` to `P6` in a file that uses G54 to G59 and no additional work "
             "offset."},
    .hooks = {.file = check}};

} // namespace feedhold::rules::offset_of_other_table
