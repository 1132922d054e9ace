// unreachable-block: blocks behind a GOTO, M99 or M30 that no jump leads to.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

namespace feedhold::rules {
namespace {

/// `#3000=1(..)` and an M30 behind it: a second end of the program is a belt beside the braces.
bool onlyEnds(const DeadBlocks::Run &run, const FileContext &context) {
  for (BlockId block = run.first; block <= run.last; block = block.next()) {
    if (!isRead(context.tree.blocks[block]) || !hasContent(context, block))
      continue;
    const FlowAfter flow = flowAfter(context.tree, block, context.dialect);
    if (flow != FlowAfter::Ends && flow != FlowAfter::Jumps)
      return false;
  }
  return true;
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  const DeadBlocks dead(context, program);
  for (const DeadBlocks::Run &run : dead.runs()) {
    if (onlyEnds(run, context))
      continue;
    const std::uint32_t first = context.source.lineOf(context.tree.blocks[run.first].begin);
    const std::uint32_t last = context.source.lineOf(context.tree.blocks[run.last].begin);
    reporter.report({.message = first == last ? "this block is never run"
                                              : fmt::format("the blocks from here to line {} are never run", last),
                     .span = context.tree.blocks[run.first].span(),
                     .labels = {{context.tree.blocks[run.ender].span(), "control does not go on behind this block"}},
                     .notes = {"no jump leads here either"}});
  }
}

} // namespace

extern const Rule unreachableBlock;
const Rule unreachableBlock{.info = {"unreachable-block", Category::Structure, Severity::Info,
                                     "Reports blocks that are never run: they stand behind a block that control leaves "
                                     "for good, and no jump leads to them."},
                            .hooks = {.program = check}};

} // namespace feedhold::rules
