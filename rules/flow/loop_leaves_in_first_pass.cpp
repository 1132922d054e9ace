// loop-leaves-in-first-pass: a jump in the loop is always taken before its END, or the program ends there.
#include "rules/flow/flow_view.h"
#include "rules/structure/structure_view.h"

#include <algorithm>
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

/// What leaves the loop in each first pass.
struct WayOut {
  BlockId block;
  Span span;
  bool conditional;
  bool isJump; // else the program ends, or returns
};

/// M99 or M30 without a condition.
std::optional<WayOut> endIn(const FlowFacts &facts, const FileContext &context, BlockId first, BlockId last) {
  for (BlockId block = first; block < last; block = block.next())
    for (const CodeRole role : {CodeRole::Return, CodeRole::ProgramEnd})
      if (const Word *code = findCode(context.tree, block, context.dialect, role);
          code && !context.tree.blocks[block].has(Block::kSkip) && reachedNode(facts, block) &&
          flowAfter(context.tree, block, context.dialect) == FlowAfter::Ends)
        return WayOut{block, code->span(), false, false};
  return std::nullopt;
}

/// A jump out of the loop that is always taken, or the end of the program.  Without one an alarm keeps the END from
/// being reached.
std::optional<WayOut> wayOut(const FlowFacts &facts, const FileContext &context, const Loop &loop) {
  for (const Jump &jump : facts.file.model->jumpsIn(loop.doBlock, *loop.endBlock)) {
    const bool leaves = jump.target && (*jump.target < loop.doBlock || *loop.endBlock < *jump.target);
    if (jump.kind == JumpKind::Goto && leaves && isAlwaysTaken(facts, jump))
      return WayOut{jump.block, jump.span, jump.conditional, true};
  }
  return endIn(facts, context, loop.doBlock.next(), *loop.endBlock);
}

/// `#1=#1+1` in the loop, and its condition reads #1.
bool hasCounter(const FlowFacts &facts, const Loop &loop) {
  const auto asked = readsOf(facts.file, loop.doBlock);
  for (BlockId block = loop.doBlock.next(); block < *loop.endBlock; block = block.next())
    for (const Statement &statement : facts.file.tree->statementsOf(block)) {
      const auto *assignment = std::get_if<Assignment>(&statement.node);
      const auto target = assignment ? variableOf(facts, assignment->target) : std::nullopt;
      const auto reads = target ? readsIn(facts.file, assignment->value, block) : std::vector<Read>{};
      const auto readsIt = [&](const Read &read) { return variableOf(facts, read.expression) == target; };
      if (std::ranges::any_of(reads, readsIt) && std::ranges::any_of(asked, readsIt))
        return true;
    }
  return false;
}

/// `WHILE[..]DO1`, some blocks, `GOTO200`, `END1`: a loop that stands for an IF of several blocks.
bool standsForIf(const FlowFacts &facts, const FileContext &context, const Loop &loop, const WayOut &out) {
  if (out.conditional || !hasCondition(context, loop) || hasCounter(facts, loop))
    return false;
  BlockId behind = out.block.next();
  while (behind < *loop.endBlock && isEmpty(context.tree, behind))
    behind = behind.next();
  return behind == *loop.endBlock;
}

void tell(const FileContext &context, Span head, Span end, const WayOut &out, const Reporter &reporter) {
  reporter.report({.message = "this loop never comes to its end: its first pass leaves it",
                   .span = head,
                   .labels = {{out.span, out.isJump ? "always taken" : "leaves the program"}, {end, "not reached"}},
                   .notes = {"what the loop should repeat is done once",
                             out.isJump && out.conditional ? "correct the condition of the jump that leaves it"
                                                           : fmt::format("put {} behind the loop, or under a condition",
                                                                         context.quoted(out.span))}});
}

/// `break`, `return`, or the end of the program in a loop of o-words.
std::optional<WayOut> wayOut(const FlowFacts &facts, const FileContext &context, ConstructId loop, BlockId head,
                             BlockId end) {
  for (const OWordUse &word : context.model.oWordsIn(head.next(), end)) {
    const bool leaves = (word.kind == OWordKind::Break && word.construct == loop) || word.kind == OWordKind::Return;
    if (leaves && word.program == facts.program && reachedNode(facts, word.block))
      return WayOut{word.block, context.tree.statements[word.statement].span, false, true};
  }
  return endIn(facts, context, head.next(), end);
}

void checkOWords(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (ConstructId id(0); id.index() < context.model.constructs.size(); id = id.next()) {
    const Construct &construct = context.model.constructs[id];
    const OWordUse &head = context.model.oWords[construct.parts.front()];
    const OWordUse &end = context.model.oWords[construct.parts.back()];
    const bool isLoop =
        construct.kind == OWordKind::While || construct.kind == OWordKind::Do || construct.kind == OWordKind::Repeat;
    if (!isLoop || !construct.closed || head.program != facts.program || reachedNode(facts, end.block))
      continue;
    if (const auto out = wayOut(facts, context, id, head.block, end.block))
      tell(context, context.tree.statements[head.statement].span, context.tree.statements[end.statement].span, *out,
           reporter);
  }
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (const Loop &loop : context.model.loopsOf(facts.program)) {
    if (loop.program != facts.program || !loop.endBlock || reachedNode(facts, *loop.endBlock))
      continue;
    const auto out = wayOut(facts, context, loop);
    if (out && !standsForIf(facts, context, loop, *out))
      tell(context, context.tree.statements[loop.doStatement].span, context.tree.statements[*loop.endStatement].span,
           *out, reporter);
  }
  checkOWords(facts, context, reporter);
}

} // namespace

extern const Rule loopLeavesInFirstPass;
const Rule loopLeavesInFirstPass{.info = {"loop-leaves-in-first-pass", Category::Flow, Severity::Warning,
                                          "Reports a loop that is left before its end in every first pass."},
                                 .hooks = {.flow = check, .flowRuns = FlowRuns::All}};

} // namespace feedhold::rules::loop_leaves_in_first_pass
