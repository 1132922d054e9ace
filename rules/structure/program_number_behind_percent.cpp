// program-number-behind-percent: `% O5000(COVER)`: the control skips the line of `%`.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace feedhold::rules::program_number_behind_percent {
namespace {

/// The rest of the line behind the sign.
Span restOfLine(const FileContext &context, BlockId percent) {
  const std::string_view text = context.source.text();
  std::size_t begin = context.tree.blocks[percent].begin;
  while (begin < text.size() && (text[begin] == '%' || isBlank(text[begin])))
    ++begin;
  const std::size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
  return {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
}

/// `O5000`, `:9027`
bool isNumber(std::string_view text) {
  return text.size() > 1 && (text.front() == 'O' || text.front() == 'o' || text.front() == ':') && isDigit(text[1]);
}

bool hasCode(const FileContext &context, BlockId block) {
  return !context.tree.statementsOf(block).empty() ||
         std::ranges::any_of(context.tree.wordsOf(block), [](const Word &word) { return word.address() != 'O'; });
}

/// The O word in front of it, if nothing else stands there.
const Word *numberBefore(const FileContext &context, BlockId percent) {
  const Word *number = nullptr;
  for (BlockId block(0); block < percent; block = block.next()) {
    if (hasCode(context, block))
      return nullptr;
    if (const Word *word = findWord(context.tree, block, 'O'))
      number = word;
  }
  return number;
}

/// Codes come behind it, before another program number.
bool beginsProgram(const FileContext &context, BlockId percent) {
  for (BlockId block = percent.next(); block.index() < context.tree.blockCount(); block = block.next()) {
    if (findWord(context.tree, block, 'O'))
      return false;
    if (hasCode(context, block))
      return true;
  }
  return false;
}

void check(const FileContext &context, const Reporter &reporter) {
  if (context.dialect.grammar.oWords)
    return;
  for (std::size_t i = 0; i < context.tree.blockCount(); ++i) {
    const BlockId block(i);
    if (!context.tree.blocks[block].has(Block::kPercent))
      continue;
    if (const Word *number = numberBefore(context, block); number && beginsProgram(context, block))
      reporter.report({.message = fmt::format("{} stands in front of the `%` that begins the program: the control "
                                              "skips it",
                                              context.quoted(number->span())),
                       .span = number->span(),
                       .labels = {{{context.tree.blocks[block].begin, context.tree.blocks[block].begin + 1},
                                   "reading begins behind this line"}},
                       .notes = {"the program comes in without its number, or the control stops",
                                 "put the number on a line of its own behind the `%`"}});
    const Span rest = restOfLine(context, block);
    if (isNumber(context.text(rest)))
      reporter.report({.message = "the control skips this line, and with it the program number",
                       .span = rest,
                       .notes = {"reading begins with the line behind the first `%`", "put the number on a line of "
                                                                                      "its own"}});
    return; // the first one begins the tape
  }
}

} // namespace

extern const Rule programNumberBehindPercent;
const Rule programNumberBehindPercent{
    .info = {"program-number-behind-percent", Category::Structure, Severity::Warning,
             "Reports a program number in the line of the first `%`, or in front of it."},
    .hooks = {.file = check}};

} // namespace feedhold::rules::program_number_behind_percent
