// block-before-contour: a move between `G71 P10 Q20` and `N10`, which the control passes over.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::block_before_contour {
namespace {

/// G70 executes its contour: where that stands behind it, no manual says how the program goes on.
bool isRoughing(const Contour &contour, const FileContext &context) {
  const Word *code = findCode(context.tree, contour.cycle->block, context.dialect, CodeRole::Contour);
  const Code *row = code ? codeOf(*code, context.dialect) : nullptr;
  return row && row->action != CodeAction::FinishContour;
}

/// A jump leads into these blocks, or from them: they are executed in another way.
bool isReachedOtherwise(BlockId first, BlockId last, ProgramId program, const FileContext &context) {
  return std::ranges::any_of(context.model.jumpsOf(program), [&](const Jump &jump) {
    const bool isFrom = first <= jump.block && jump.block <= last;
    const bool isTo = jump.target && first <= *jump.target && *jump.target <= last;
    return isFrom || isTo;
  });
}

bool saysSomething(BlockId block, const FileContext &context) {
  return !context.tree.statementsOf(block).empty() ||
         std::ranges::any_of(context.tree.wordsOf(block), [](const Word &word) { return word.address() != 'N'; });
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  for (const Contour &contour : contoursOf(program, context)) {
    if (!contour.standsBehindCycle() || !isRoughing(contour, context))
      continue;
    const BlockId next = contour.cycle->block.next();
    BlockId block = next;
    while (block < contour.first && !saysSomething(block, context))
      block = block.next();
    if (block == contour.first || isReachedOtherwise(next, BlockId(contour.first.index() - 1), program, context))
      continue;
    const auto lineOf = [&](BlockId of) { return context.source.lineOf(context.tree.blocks[of].begin); };
    reporter.report(
        {.message = "the control passes over this block, which stands between a cycle and its contour",
         .span = context.tree.blocks[block].span(),
         .labels = {{context.tree.blocks[contour.cycle->block].span(),
                     fmt::format("its contour is lines {} to {}", lineOf(contour.first), lineOf(contour.last))}},
         .notes = {fmt::format("behind the cycle the program goes on after line {}", lineOf(contour.last)),
                   "put the block before the cycle, or let P name it"}});
  }
}

} // namespace

extern const Rule blockBeforeContour;
const Rule blockBeforeContour{
    .info = {"block-before-contour", Category::Structure, Severity::Warning,
             "Reports a block between a roughing cycle of a lathe and the contour that P and Q "
             "of the cycle name."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::block_before_contour
