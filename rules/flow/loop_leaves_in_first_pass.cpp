// loop-leaves-in-first-pass: a jump in the loop is always taken before its END.
#include "rules/flow/flow_view.h"
#include "rules/structure/structure_view.h"

#include <fmt/format.h>

namespace feedhold::rules::loop_leaves_in_first_pass {
namespace {

/// Control comes to the jump and always takes it.
bool isAlwaysTaken(const FlowFacts &facts, const Jump &jump) {
  if (!reachedNode(facts, jump.block))
    return false;
  for (NodeId node = facts.file.cfg.nodeOf(jump.block); node < facts.end(); node = node.next()) {
    if (facts.node(node).block != jump.block)
      break;
    if (std::holds_alternative<Test>(facts.node(node).instruction))
      return facts.truthOf(node) == Truth::True;
  }
  return !jump.conditional;
}

/// A jump out of the loop that is always taken.  Without one an alarm, or the end of the program, keeps the END from
/// being reached.
const Jump *wayOut(const FlowFacts &facts, const Loop &loop) {
  for (const Jump &jump : facts.file.model->jumpsIn(loop.doBlock, *loop.endBlock)) {
    const bool leaves = jump.target && (*jump.target < loop.doBlock || *loop.endBlock < *jump.target);
    if (jump.kind == JumpKind::Goto && leaves && isAlwaysTaken(facts, jump))
      return &jump;
  }
  return nullptr;
}

/// `WHILE[..]DO1`, some blocks, `GOTO200`, `END1`: a loop that stands for an IF of several blocks.
bool standsForIf(const FileContext &context, const Loop &loop, const Jump &jump) {
  if (jump.conditional || !hasCondition(context, loop))
    return false;
  BlockId behind = jump.block.next();
  while (behind < *loop.endBlock && isEmpty(context.tree, behind))
    behind = behind.next();
  return behind == *loop.endBlock;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (const Loop &loop : context.model.loopsOf(facts.program)) {
    if (loop.program != facts.program || !loop.endBlock || reachedNode(facts, *loop.endBlock))
      continue;
    const Jump *jump = wayOut(facts, loop);
    if (!jump || standsForIf(context, loop, *jump))
      continue;
    reporter.report(
        {.message = "this loop never comes to its END: its first pass leaves it",
         .span = context.tree.statements[loop.doStatement].span,
         .labels = {{jump->span, "always taken"}, {context.tree.statements[*loop.endStatement].span, "not reached"}},
         .notes = {"what the loop should repeat is done once", "correct the condition of the jump that leaves it"}});
  }
}

} // namespace

extern const Rule loopLeavesInFirstPass;
const Rule loopLeavesInFirstPass{.info = {"loop-leaves-in-first-pass", Category::Flow, Severity::Warning,
                                          "Reports a loop that is left before its `END` in every first pass."},
                                 .hooks = {.flow = check, .flowRuns = FlowRuns::All}};

} // namespace feedhold::rules::loop_leaves_in_first_pass
