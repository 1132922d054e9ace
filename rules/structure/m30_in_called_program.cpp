// m30-in-called-program: the whole job ends where M99 was meant.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

namespace feedhold::rules::m30_in_called_program {
namespace {

/// A call from another program that has more to do behind it; M97 and a program that calls itself are no proof that
/// this one is a subprogram.
std::optional<CallGraph::Caller> foreignCaller(const FileContext &context, ProgramId program) {
  for (const auto &caller : context.callGraph.callers({context.file, program})) {
    const Call &call = context.callGraph.model(caller.file).calls[caller.call];
    const bool isItself = caller.file == context.file && call.caller == program;
    if (!isItself && !call.isLast && call.kind != CallKind::Local)
      return caller;
  }
  return std::nullopt;
}

void reportEnd(const Word &end, const CallGraph::Caller &caller, const FileContext &context, const Reporter &reporter) {
  const Call &call = context.callGraph.model(caller.file).calls[caller.call];
  reporter.report({.message = fmt::format("{} in a called program ends the whole job", context.quoted(end.span())),
                   .span = end.span(),
                   .labels = {{call.span, "called here", caller.file}},
                   .notes = {"the blocks after the call are never executed: retracts, restored modes, counters",
                             call.kind == CallKind::OWord
                                 ? "a subroutine returns at its `endsub`"
                                 : "return with M99; where the job must stop, raise an alarm with `#3000=`"}});
}

void check(ProgramId id, const FileContext &context, const Reporter &reporter) {
  const auto caller = foreignCaller(context, id);
  if (!caller)
    return;
  const Program &program = context.model.programs[id];
  const BranchBlocks branches(context.model);
  std::optional<DeadBlocks> dead;
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    const Word *end = isRead(context.tree.blocks[block])
                          ? findCode(context.tree, block, context.dialect, CodeRole::ProgramEnd)
                          : nullptr;
    // Under an `if` of o-words it is the way to stop the job, as `#3000=` elsewhere.
    if (!end || branches.contains(block))
      continue;
    if (!dead)
      dead.emplace(context, id);
    if (!dead->contains(block))
      reportEnd(*end, *caller, context, reporter);
  }
}

} // namespace

extern const Rule m30InCalledProgram;
const Rule m30InCalledProgram{.info = {"m30-in-called-program", Category::Structure, Severity::Info,
                                       "Reports `M02` or `M30` in a program that another program calls."},
                              .hooks = {.program = check}};

} // namespace feedhold::rules::m30_in_called_program
