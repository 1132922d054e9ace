// machine-code-without-axis: `G90 G53 G00`, and `Z0` in the next block.
#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

namespace feedhold::rules::machine_code_without_axis {
namespace {

bool namesAxis(BlockId block, const FileContext &context) {
  return std::ranges::any_of(context.tree.wordsOf(block), [](const Word &word) {
    return std::string_view("XYZABCUVW").find(word.address()) != std::string_view::npos;
  });
}

/// The next block that names axes, if it moves them in work coordinates.
std::optional<BlockId> moveBehind(BlockId block, const FileContext &context) {
  const Program &program = context.model.programs[context.model.programOf(block)];
  for (BlockId each = block.next(); each < program.last; each = each.next())
    if (namesAxis(each, context)) {
      const auto words = context.tree.wordsOf(each);
      const bool isPlain = std::ranges::none_of(words, [&](const Word &word) {
        const Code *code = word.isCode() ? codeOf(word, context.dialect) : nullptr;
        return code && code->group == 0 && word.address() == 'G';
      });
      return isPlain ? std::optional(each) : std::nullopt;
    }
  return std::nullopt;
}

/// Nothing but M codes up to M30 or M02: the block was to take the tool away.
bool endsBehind(BlockId block, const FileContext &context) {
  const Program &program = context.model.programs[context.model.programOf(block)];
  for (BlockId each = block; each < program.last; each = each.next()) {
    const auto words = context.tree.wordsOf(each);
    if (!context.tree.statementsOf(each).empty() || context.tree.blocks[each].has(Block::kBroken) ||
        (each != block &&
         std::ranges::any_of(words, [](const Word &word) { return word.address() != 'M' && word.address() != 'N'; })))
      return false;
    if (findCode(context.tree, each, context.dialect, CodeRole::ProgramEnd))
      return true;
  }
  return false;
}

void tellAtEnd(const Word &code, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = fmt::format("{} has no axis beside it, and no effect", context.quoted(code.span())),
                   .span = code.span(),
                   .notes = {"no axis moves before the program ends: the tool stays where the last block left it",
                             "write the axis and where it goes, such as `G53 Z0`"}});
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  const Word *code = findAction(context.tree, block, context.dialect, {CodeAction::MachineMove});
  if (!code || context.tree.blocks[block].has(Block::kBroken) || namesAxis(block, context) ||
      !context.model.callsIn(block, block.next()).empty())
    return;
  if (endsBehind(block, context))
    return tellAtEnd(*code, context, reporter);
  // Without a motion code it is a habit: such a block keeps FANUC controls from reading ahead.
  if (!findAction(context.tree, block, context.dialect, {CodeAction::Rapid, CodeAction::Linear}))
    return;
  const auto move = moveBehind(block, context);
  if (!move)
    return;
  reporter.report({.message = fmt::format("{} has no axis beside it, and no effect", context.quoted(code->span())),
                   .span = code->span(),
                   .labels = {{context.tree.blocks[*move].span(), "moves in work coordinates"}},
                   .notes = {"it holds for its own block only: a block behind it moves in work coordinates",
                             "write it in the block with the axes"}});
}

} // namespace

extern const Rule machineCodeWithoutAxis;
const Rule machineCodeWithoutAxis{
    .info = {"machine-code-without-axis", Category::Motion, Severity::Warning,
             "Reports `G00 G53` in a block that moves no axis, and `G53` alone before the end of the program."},
    .hooks = {.block = check}};

} // namespace feedhold::rules::machine_code_without_axis
