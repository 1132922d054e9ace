// end-without-do: `END1` that no `DO1` leads to.
#include "findings/rule/rule.h"

#include "base/support/text.h"
#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::end_without_do {
namespace {

/// The first DO without an END: an END behind it may be its own with a mistyped number, and do-without-end says so.
std::optional<BlockId> firstOpenDo(ProgramId program, const ProgramModel &model) {
  const auto loops = model.loopsOf(program);
  const auto open = std::ranges::find_if(loops, [](const Loop &loop) { return loop.number && !loop.endBlock; });
  return open == loops.end() ? std::nullopt : std::optional(open->doBlock);
}

/// A block that could not be read holds the `DO`: that is what is reported.
bool hasUnreadDo(ProgramId program, const LoneEnd &end, const FileContext &context) {
  const std::string wanted = fmt::format("DO{}", *end.number);
  for (BlockId block = context.model.programs[program].first; block < end.block; block = block.next()) {
    const Block &row = context.tree.blocks[block];
    if (row.has(Block::kBroken) && toUpper(context.text({row.begin, row.end})).find(wanted) != std::string::npos)
      return true;
  }
  return false;
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  std::optional<DeadBlocks> dead;
  const std::optional<BlockId> openDo = firstOpenDo(program, context.model);
  for (const LoneEnd &end : context.model.loneEndsOf(program)) {
    if (!end.number || (openDo && *openDo < end.block))
      continue;
    if (!dead)
      dead.emplace(context, program);
    if (dead->contains(end.block) || hasUnreadDo(program, end, context))
      continue;
    reporter.report({.message = fmt::format("`END{}` has no `DO{}`", *end.number, *end.number),
                     .span = context.tree.statements[end.statement].span,
                     .notes = {fmt::format("when it reaches this block, the control {}",
                                           stopsWith(context.dialect, AlarmKind::MissingDo))}});
  }
}

} // namespace

extern const Rule endWithoutDo;
const Rule endWithoutDo{
    .info = {"end-without-do", Category::Structure, Severity::Error, "Reports an `END` without a matching `DO`."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::end_without_do
