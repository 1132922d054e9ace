// modes-restored-unsaved: `M72` in a program that has no `M70` and no `M73`.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::modes_restored_unsaved {
namespace {

/// What a caller or a called program has saved does not count: each has its own.
void check(ProgramId id, const FileContext &context, const Reporter &reporter) {
  if (!savesModes(context.dialect))
    return;
  const Program &program = context.model.programs[id];
  const Word *restore = nullptr;
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    if (findAction(context.tree, block, context.dialect, {CodeAction::ModesSave, CodeAction::ModesSaveForReturn}) ||
        context.tree.blocks[block].has(Block::kBroken))
      return;
    if (const Word *word = findAction(context.tree, block, context.dialect, {CodeAction::ModesRestore}))
      restore = restore ? restore : word;
  }
  if (restore)
    reporter.report(
        {.message = fmt::format("{} restores modes that nothing has saved", context.quoted(restore->span())),
         .span = restore->span(),
         .notes = {"the control stops with an error: what a caller has saved is not for this program",
                   "write `M70` before it, in the same program"}});
}

} // namespace

extern const Rule modesRestoredUnsaved;
const Rule modesRestoredUnsaved{.info = {"modes-restored-unsaved", Category::Motion, Severity::Error,
                                         "Reports `M72` in a program that saves no modes with `M70` or `M73`."},
                                .hooks = {.program = check}};

} // namespace feedhold::rules::modes_restored_unsaved
