// recursive-call: a program that calls itself, alone or through others.
#include "findings/rule/rule.h"

#include "rules/calls/call_view.h"
#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::recursive_call {
namespace {

const ProgramName &nameOf(ProgramRef ref, const FileContext &context) {
  return context.callGraph.model(ref.file).programs[ref.program].name;
}

/// "`O1` calls `O2` calls `O1`"
std::string chain(const std::vector<ProgramRef> &cycle, const FileContext &context) {
  std::string text;
  for (const ProgramRef &ref : cycle)
    text += fmt::format("`{}` calls ", toString(nameOf(ref, context)));
  return text + fmt::format("`{}`", toString(nameOf(cycle.front(), context)));
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.callGraph.depthFrom({context.file, program})) // has an end, so nothing comes back
    return;
  const auto cycle = context.callGraph.cycleThrough({context.file, program});
  if (cycle.empty() || std::ranges::any_of(cycle, [&](ProgramRef ref) { return nameOf(ref, context).empty(); }))
    return; // or a number that only the name of the file gives: the mistyped `0010` may be meant otherwise
  const Call *call = callTo(context, program, cycle.size() > 1 ? cycle[1] : cycle[0]);
  // Subroutines with parameters of their own recur with reason; it ends where an `if` says so.
  if (!call || (call->kind == CallKind::OWord && BranchBlocks(context.model).contains(call->block)))
    return;
  reporter.report(
      {.message = fmt::format("{} calls this program again", context.quoted(call->span)),
       .span = call->span,
       .notes = {chain(cycle, context), fmt::format("if nothing ends the chain, the control {}",
                                                    stopsWith(context.dialect, AlarmKind::SubprogramNesting))}});
}

} // namespace

extern const Rule recursiveCall;
const Rule recursiveCall{.info = {"recursive-call", Category::Call, Severity::Warning,
                                  "Reports a program that calls itself, directly or through other programs."},
                         .hooks = {.program = check}};

} // namespace feedhold::rules::recursive_call
