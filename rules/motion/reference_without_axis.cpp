// reference-without-axis: `G91`, `G28`, `X0`, `Z0`: four blocks that were to be one.
#include "findings/rule/dead_blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace feedhold::rules::reference_without_axis {
namespace {

/// Nothing but codes: `G28`, `G91 G28`, `N10 G91`.
bool holdsOnlyCodes(BlockId block, const FileContext &context) {
  return context.tree.statementsOf(block).empty() &&
         std::ranges::all_of(context.tree.wordsOf(block),
                             [](const Word &word) { return word.isCode() || word.address() == 'N'; });
}

/// Nothing but axes, all of them 0.
const Word *zeroAxis(BlockId block, std::string_view axes, const FileContext &context) {
  const auto words = context.tree.wordsOf(block);
  const bool isZero = std::ranges::all_of(words, [&](const Word &word) {
    return axes.find(word.address()) != std::string_view::npos && word.isNumber() && word.number().isZero();
  });
  return isZero && !words.empty() && context.tree.statementsOf(block).empty() ? &words.front() : nullptr;
}

std::optional<BlockId> behind(BlockId block, const Program &program, const FileContext &context) {
  for (BlockId each = block.next(); each < program.last; each = each.next())
    if (hasContent(context, each))
      return each;
  return std::nullopt;
}

bool isIncremental(BlockId block, const Program &program, const FileContext &context) {
  if (findAction(context.tree, block, context.dialect, {CodeAction::Incremental}))
    return true;
  for (std::uint32_t i = block.index(); i-- > program.first.index();)
    if (const BlockId each(i); hasContent(context, each))
      return holdsOnlyCodes(each, context) &&
             findAction(context.tree, each, context.dialect, {CodeAction::Incremental}) != nullptr;
  return false;
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  const Word *code =
      findAction(context.tree, block, context.dialect, {CodeAction::ReferenceReturn, CodeAction::SecondReference});
  if (!code || context.dialect.grammar.oWords || !holdsOnlyCodes(block, context)) // LinuxCNC returns all axes
    return;
  const Program &program = context.model.programs[context.model.programOf(block)];
  const auto next = behind(block, program, context);
  const bool isTurning = context.dialect.machine == MachineKind::Turning;
  const Word *axis = next ? zeroAxis(*next,
                                     isIncremental(block, program, context) ? "XYZABCUVW"
                                     : isTurning                            ? "UW"
                                                                            : "",
                                     context)
                          : nullptr;
  if (!axis)
    return;
  reporter.report({.message = fmt::format("{} names no axis: {} stands in a block of its own",
                                          context.quoted(code->span()), context.quoted(axis->span())),
                   .span = code->span(),
                   .labels = {{context.tree.blocks[*next].span(), "this block moves nothing"}},
                   .notes = {"without an axis some controls return none, and others all of them at once",
                             "write the axes in the block of the code"}});
}

} // namespace

extern const Rule referenceWithoutAxis;
const Rule referenceWithoutAxis{
    .info = {"reference-without-axis", Category::Motion, Severity::Warning,
             "Reports a reference return without axes when the next block has them, with 0 as increments."},
    .hooks = {.block = check}};

} // namespace feedhold::rules::reference_without_axis
