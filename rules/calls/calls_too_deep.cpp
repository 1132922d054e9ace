// calls-too-deep: a chain of calls longer than the control can hold.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::calls_too_deep {
namespace {

void check(ProgramId id, const FileContext &context, const Reporter &reporter) {
  const ProgramRef self{context.file, id};
  // The program that begins the chain is reported, not each of its links.
  if (context.callGraph.isCalled(self))
    return;
  const auto depth = context.callGraph.depthFrom(self);
  if (!depth)
    return;
  const Limits &limits = context.dialect.limits;
  const bool macros = depth->macro > limits.macroCallDepth;
  if (!macros && depth->total <= limits.totalCallDepth)
    return;
  reporter.report(
      {.message = fmt::format("calls are nested {} levels deep from here; this control allows {}{}",
                              macros ? depth->macro : depth->total,
                              macros ? limits.macroCallDepth : limits.totalCallDepth, macros ? " macro calls" : ""),
       .span = context.model.programs[id].header,
       .notes = {fmt::format("the control {}", stopsWith(context.dialect, macros ? AlarmKind::MacroNesting
                                                                                 : AlarmKind::SubprogramNesting)),
                 "merge some of the programs, or replace a call by a loop"}});
}

} // namespace

extern const Rule callsTooDeep;
const Rule callsTooDeep{.info = {"calls-too-deep", Category::Call, Severity::Error,
                                 "Reports a program whose calls are nested deeper than the control allows."},
                        .hooks = {.program = check}};

} // namespace feedhold::rules::calls_too_deep
