// loops-too-deep: a loop in a loop in a loop in a loop.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

namespace feedhold::rules::loops_too_deep {
namespace {

void check(const FileContext &context, const Reporter &reporter) {
  const std::size_t limit = context.dialect.limits.loopDepth;
  std::vector<const Loop *> open;
  for (const Loop &loop : context.model.loops) {
    std::erase_if(open,
                  [&](const Loop *outer) { return outer->program != loop.program || !isInside(*outer, loop.doBlock); });
    open.push_back(&loop);
    if (open.size() != limit + 1)
      continue;
    Diagnostic diagnostic{
        .message = fmt::format("this loop is inside {} others; this control nests at most {} loops", limit, limit),
        .span = context.tree.statements[loop.doStatement].span,
        .labels = {{context.tree.statements[open.front()->doStatement].span, "the outermost loop begins here"}},
        .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::LoopNumber)),
                  "move the inner loop to a macro and call it"}};
    reporter.report(std::move(diagnostic));
  }
}

} // namespace

extern const Rule loopsTooDeep;
const Rule loopsTooDeep{.info = {"loops-too-deep", Category::Structure, Severity::Error,
                                 "Reports loops nested deeper than the control allows."},
                        .hooks = {.file = check}};

} // namespace feedhold::rules::loops_too_deep
