// contour-without-end: `G71 P10`, and the Q is missing or stands in the next block.
#include "findings/rule/rule.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::contour_without_end {
namespace {

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Turning || context.tree.blocks[block].has(Block::kBroken))
    return;
  const Word *cycle = findCode(context.tree, block, context.dialect, CodeRole::Contour);
  const Word *first = cycle ? findWord(context.tree, block, 'P') : nullptr;
  if (!first || !first->isNumber() || findWord(context.tree, block, 'Q'))
    return;
  Diagnostic diagnostic{
      .message = fmt::format("{} has the first block of the contour, but no `Q` with the last one",
                             context.quoted(cycle->span())),
      .span = first->span(),
      .notes = {"the control does not know where the contour ends, and stops", "write P and Q in one block"}};
  const BlockId next = block.next();
  if (next.index() < context.tree.blockCount())
    if (const Word *last = findWord(context.tree, next, 'Q'))
      diagnostic.labels = {{last->span(), "in a block of its own, it belongs to no cycle"}};
  reporter.report(std::move(diagnostic));
}

} // namespace

extern const Rule contourWithoutEnd;
const Rule contourWithoutEnd{.info = {"contour-without-end", Category::Structure, Severity::Error,
                                      "Reports a contour cycle of a lathe with `P` and without `Q`."},
                             .hooks = {.block = check}};

} // namespace feedhold::rules::contour_without_end
