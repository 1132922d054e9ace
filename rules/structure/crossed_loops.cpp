// crossed-loops: `DO1 .. DO2 .. END1 .. END2`.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

namespace feedhold::rules::crossed_loops {
namespace {

Span span(StatementId statement, const FileContext &context) { return context.tree.statements[statement].span; }

bool cross(const Loop &outer, const Loop &inner) {
  return outer.program == inner.program && outer.number && inner.number && outer.number != inner.number &&
         isInside(outer, inner.doBlock) && inner.endBlock && *inner.endBlock > *outer.endBlock;
}

void check(const FileContext &context, const Reporter &reporter) {
  const std::vector<Loop> &loops = context.model.loops;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    for (std::size_t k = i + 1; k < loops.size() && isInside(loops[i], loops[k].doBlock); ++k) {
      if (!cross(loops[i], loops[k]))
        continue;
      reporter.report(
          {.message = fmt::format("`END{0}` comes before `END{1}`, but loop {1} begins inside loop {0}",
                                  *loops[i].number, *loops[k].number),
           .span = span(*loops[i].endStatement, context),
           .labels = {{span(loops[i].doStatement, context), "the outer loop begins here"},
                      {span(loops[k].doStatement, context), "the inner loop begins here"},
                      {span(*loops[k].endStatement, context), "the inner loop must end before the outer one"}},
           .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::MissingEnd)),
                     "end the inner loop before the outer one"}});
      break; // one finding for each outer loop
    }
  }
}

} // namespace

extern const Rule crossedLoops;
const Rule crossedLoops{.info = {"crossed-loops", Category::Structure, Severity::Error,
                                 "Reports two loops that overlap, so that neither encloses the other."},
                        .hooks = {.file = check}};

} // namespace feedhold::rules::crossed_loops
