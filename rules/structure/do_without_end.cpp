// do-without-end: `WHILE[..]DO1` and no `END1` behind it.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

namespace feedhold::rules::do_without_end {
namespace {

/// The END that was meant: the only one of the program that is left over.
const LoneEnd *leftOverEnd(const Loop &loop, const ProgramModel &model) {
  const auto ends = model.loneEndsIn(loop.doBlock, model.programs[loop.program].last);
  return ends.size() == 1 ? &ends.front() : nullptr;
}

void addRepair(Diagnostic &diagnostic, const Loop &loop, const FileContext &context) {
  const LoneEnd *end = leftOverEnd(loop, context.model);
  if (!end)
    return;
  const Span span = context.tree.statements[end->statement].span;
  diagnostic.labels.push_back({span, "this END has no DO"});
  diagnostic.fixes.push_back(
      {.title = fmt::format("write `END{}`", *loop.number), .edits = {{span, fmt::format("END{}", *loop.number)}}});
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  std::optional<DeadBlocks> dead;
  for (const Loop &loop : context.model.loopsOf(program)) {
    if (!loop.number || loop.endBlock)
      continue;
    if (!dead)
      dead.emplace(context, program);
    if (dead->contains(loop.doBlock))
      continue;
    Diagnostic diagnostic{.message = fmt::format("`DO{}` has no `END{}`", *loop.number, *loop.number),
                          .span = context.tree.statements[loop.doStatement].span,
                          .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::MissingEnd))}};
    addRepair(diagnostic, loop, context);
    reporter.report(std::move(diagnostic));
  }
}

} // namespace

extern const Rule doWithoutEnd;
const Rule doWithoutEnd{.info = {"do-without-end", Category::Structure, Severity::Error,
                                 "Reports a `DO` without a later `END` of the same number."},
                        .hooks = {.program = check}};

} // namespace feedhold::rules::do_without_end
