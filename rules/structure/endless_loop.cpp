// endless-loop: a DO without WHILE that nothing ever leaves, and a block that jumps to itself.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::endless_loop {
namespace {

/// A target in the loop, its DO included, keeps control inside.
bool staysInside(const Loop &loop, const Jump &jump) {
  return jump.target && (*jump.target == loop.doBlock || isInside(loop, *jump.target));
}

bool hasWayOut(const Loop &loop, const FileContext &context) {
  const BlockId behind = loop.endBlock->next();
  // What a called program does is not known from here: it may stop with an alarm or return elsewhere.
  return !context.model.callsIn(loop.doBlock, behind).empty() ||
         std::ranges::any_of(context.model.jumpsIn(loop.doBlock, behind),
                             [&](const Jump &jump) { return !staysInside(loop, jump); });
}

/// An M code that the tables do not know: the machine builder may have made a call or a stop of it.
bool hasUnknownMCode(const FileContext &context, BlockId block) {
  return std::ranges::any_of(context.tree.wordsOf(block), [&](const Word &word) {
    return word.address() == 'M' && word.isCode() && !codeOf(word, context.dialect);
  });
}

/// M30, M99, an alarm; under a condition, too.  M00 waits for a person, who may leave the loop by a reset.  A block
/// that does not parse may do anything.
bool mayEnd(const Loop &loop, const FileContext &context) {
  for (BlockId block = loop.doBlock; block <= *loop.endBlock; block = block.next()) {
    if (context.tree.blocks[block].has(Block::kBroken) || hasUnknownMCode(context, block))
      return true;
    for (const CodeRole role : {CodeRole::ProgramEnd, CodeRole::Return, CodeRole::ProgramStop})
      if (findCode(context.tree, block, context.dialect, role))
        return true;
  }
  return std::ranges::any_of(context.model.variablesIn(loop.doBlock, loop.endBlock->next()),
                             [](const VariableUse &use) { return use.write && use.number == kAlarmVariable; });
}

/// `N12GOTO12`
void checkJump(const Jump &jump, const FileContext &context, const Reporter &reporter) {
  if (jump.kind != JumpKind::Goto || jump.conditional || jump.target != jump.block ||
      context.tree.blocks[jump.block].has(Block::kBroken) ||
      std::ranges::any_of(context.tree.wordsOf(jump.block), [](const Word &word) { return word.address() != 'N'; }))
    return;
  reporter.report({.message = "this block jumps to itself and never ends",
                   .span = jump.span,
                   .notes = {"only reset stops it; end the program with M30, M99 or an alarm instead"}});
}

void check(const FileContext &context, const Reporter &reporter) {
  for (const Jump &jump : context.model.jumps)
    checkJump(jump, context, reporter);
  for (const Loop &loop : context.model.loops) {
    if (!loop.endBlock || hasCondition(context, loop) || hasWayOut(loop, context) || mayEnd(loop, context))
      continue;
    reporter.report(
        {.message = "this loop never ends: it has no condition and nothing inside leaves it",
         .span = context.tree.statements[loop.doStatement].span,
         .labels = {{context.tree.statements[*loop.endStatement].span, "always goes back to the DO"}},
         .notes = {"only reset or an alarm stops it; add `WHILE[..]` before the DO, or leave with `IF[..]GOTO`"}});
  }
}

} // namespace

extern const Rule endlessLoop;
const Rule endlessLoop{
    .info = {"endless-loop", Category::Structure, Severity::Warning,
             "Reports a `DO` without `WHILE` that nothing inside the loop ever leaves, and a block that "
             "jumps to itself."},
    .hooks = {.file = check}};

} // namespace feedhold::rules::endless_loop
