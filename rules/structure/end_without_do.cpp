// end-without-do: `END1` that no `DO1` leads to.
#include "findings/rule/rule.h"

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

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  std::optional<DeadBlocks> dead;
  const std::optional<BlockId> openDo = firstOpenDo(program, context.model);
  for (const LoneEnd &end : context.model.loneEndsOf(program)) {
    if (!end.number || (openDo && *openDo < end.block))
      continue;
    if (!dead)
      dead.emplace(context, program);
    if (dead->contains(end.block))
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
