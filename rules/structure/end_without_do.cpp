// end-without-do: `END1` that no `DO1` leads to.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules {
namespace {

/// An END with another number belongs here, and do-without-end says so.
bool isMistypedEnd(const LoneEnd &end, const ProgramModel &model) {
  return std::ranges::any_of(model.loops, [&](const Loop &loop) {
    return loop.program == end.program && loop.number && !loop.endBlock && loop.doBlock < end.block;
  });
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  std::optional<DeadBlocks> dead;
  for (const LoneEnd &end : context.model.loneEnds) {
    if (end.program != program || !end.number || isMistypedEnd(end, context.model))
      continue;
    if (!dead)
      dead.emplace(context, program);
    if (dead->contains(end.block))
      continue;
    reporter.report({.message = fmt::format("`END{}` without `DO{}`", *end.number, *end.number),
                     .span = context.tree.statements[end.statement].span,
                     .notes = {fmt::format("when it is reached, the control {}",
                                           stopsWith(context.dialect, AlarmKind::MissingDo))}});
  }
}

} // namespace

extern const Rule endWithoutDo;
const Rule endWithoutDo{.info = {"end-without-do", Category::Structure, Severity::Error,
                                 "Reports an `END` that no `DO` of its number leads to."},
                        .hooks = {.program = check}};

} // namespace feedhold::rules
