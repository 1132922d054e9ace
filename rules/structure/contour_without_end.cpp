// contour-without-end: `G71 P10`, and the Q is missing or stands in the next block; `G71 Q20`, `G70`.
#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::contour_without_end {
namespace {

/// The Q of the block behind the cycle.
const Word *endBehind(BlockId block, const FileContext &context) {
  const BlockId next = block.next();
  const Word *last = next.index() < context.tree.blockCount() ? findWord(context.tree, next, 'Q') : nullptr;
  return last && last->isNumber() && !findWord(context.tree, next, 'G') ? last : nullptr;
}

bool hasSequenceNumber(std::uint32_t number, BlockId block, const FileContext &context) {
  const auto numbers = sortedSequenceNumbers(context.model, context.model.programOf(block));
  return std::ranges::any_of(numbers, [&](const SequenceNumber &each) { return each.number == number; });
}

/// `G71 Q20 U0.4`: no P.  `G70`: neither; other cycles are given their depth of cut in such a block.
void checkStart(BlockId block, const Word &cycle, const FileContext &context, const Reporter &reporter) {
  const Word *last = findWord(context.tree, block, 'Q');
  const Code *code = codeOf(cycle, context.dialect);
  const bool isFinish = code && code->action == CodeAction::FinishContour;
  if (!context.dialect.hasFanucParameters || (!isFinish && !last))
    return;
  const Word &shown = last ? *last : cycle;
  reporter.report({.message = last ? fmt::format("{} has the last block of the contour, but no `P` with the first one",
                                                 context.quoted(cycle.span()))
                                   : fmt::format("{} has neither `P` nor `Q`, the blocks of the contour",
                                                 context.quoted(cycle.span())),
                   .span = shown.span(),
                   .notes = {"the control stops with PS0061 (P or Q missing)", "write P and Q in one block"}});
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Turning || context.tree.blocks[block].has(Block::kBroken))
    return;
  const Word *cycle = findCode(context.tree, block, context.dialect, CodeRole::Contour);
  const Word *first = cycle ? findWord(context.tree, block, 'P') : nullptr;
  if (cycle && !first)
    return checkStart(block, *cycle, context, reporter);
  if (!first || !first->isNumber() || findWord(context.tree, block, 'Q'))
    return;
  Diagnostic diagnostic{
      .message = fmt::format("{} has the first block of the contour, but no `Q` with the last one",
                             context.quoted(cycle->span())),
      .span = first->span(),
      .notes = {"the control does not know where the contour ends, and stops", "write P and Q in one block"}};
  if (const Word *last = endBehind(block, context)) {
    diagnostic.labels = {{last->span(), "in a block of its own, it belongs to no cycle"}};
    const auto number = last->integer();
    if (number && !hasSequenceNumber(*number, block, context))
      diagnostic.notes.push_back(
          fmt::format("and this program has no `N{}`: give {} the number of the last block of the contour", *number,
                      context.quoted(last->span())));
  }
  reporter.report(std::move(diagnostic));
}

} // namespace

extern const Rule contourWithoutEnd;
const Rule contourWithoutEnd{
    .info = {"contour-without-end", Category::Structure, Severity::Error,
             "Reports a contour cycle of a lathe with one of `P` and `Q`, and a `G70` without both."},
    .hooks = {.block = check}};

} // namespace feedhold::rules::contour_without_end
