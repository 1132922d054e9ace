// runs-into-local-subprogram: `M97 P260`, and behind it `N260` .. `M99`, `M30`.
#include "rules/structure/structure_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::runs_into_local_subprogram {
namespace {

bool isTarget(BlockId block, const FileContext &context) {
  return std::ranges::any_of(
      context.model.jumps, [&](const Jump &jump) { return jump.kind == JumpKind::LocalCall && jump.target == block; });
}

bool goesOn(BlockId block, const FileContext &context) {
  const FlowAfter after = flowAfter(context.tree, block, context.dialect);
  return after == FlowAfter::Next || after == FlowAfter::MayJump;
}

/// The control comes from the call to the subprogram without another jump.
bool leadsTo(const Jump &call, BlockId target, const FileContext &context) {
  for (BlockId block = call.block; block < target; block = block.next())
    if (!goesOn(block, context) || context.tree.blocks[block].has(Block::kBroken) ||
        (block != call.block &&
         (isTarget(block, context) || findCode(context.tree, block, context.dialect, CodeRole::LocalCall))))
      return false;
  return true;
}

/// The M99 at which the subprogram returns, and the M30 behind it that is there to end the program.
struct Ends {
  const Word *back = nullptr;
  const Word *last = nullptr;
};
Ends endsBehind(BlockId target, const Program &program, const FileContext &context) {
  Ends ends;
  for (BlockId block = target; block < program.last && !ends.last; block = block.next()) {
    if (!ends.back && !goesOn(block, context))
      ends.back = findCode(context.tree, block, context.dialect, CodeRole::Return);
    ends.last = findCode(context.tree, block, context.dialect, CodeRole::ProgramEnd);
  }
  return ends;
}

bool endsBefore(BlockId target, const Program &program, const FileContext &context) {
  for (BlockId block = program.first; block < target; block = block.next())
    if (findCode(context.tree, block, context.dialect, CodeRole::ProgramEnd))
      return true;
  return false;
}

void check(const Jump &call, const FileContext &context, const Reporter &reporter) {
  if (call.kind != JumpKind::LocalCall || !call.target || *call.target <= call.block ||
      context.callGraph.isCalled({context.file, call.program}))
    return;
  const Program &program = context.model.programs[call.program];
  const Ends ends = endsBehind(*call.target, program, context);
  if (!ends.back || !ends.last || ends.last->span().begin < ends.back->span().begin ||
      endsBefore(*call.target, program, context) || !leadsTo(call, *call.target, context))
    return;
  reporter.report(
      {.message = fmt::format("the program runs on into the subprogram that {} calls", context.quoted(call.span)),
       .span = context.tree.blocks[*call.target].span(),
       .labels = {{call.span, "called here"},
                  {ends.back->span(), "starts the program again from its first block"},
                  {ends.last->span(), "never reached"}},
       .notes = {"without a caller, its `M99` is that of the main program: the part is machined again and again",
                 "end the main program with M30 before the subprogram"}});
}

} // namespace

extern const Rule runsIntoLocalSubprogram;
const Rule runsIntoLocalSubprogram{
    .info = {"runs-into-local-subprogram", Category::Structure, Severity::Warning,
             "Reports a main program that runs on into the subprogram that it calls by `M97`."},
    .hooks = {.jump = check}};

} // namespace feedhold::rules::runs_into_local_subprogram
