// jump-to-next-block: `IF[#1LT0]GOTO10`, and N10 is the next block.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"
#include "rules/structure/structure_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::jump_to_next_block {
namespace {

bool hasIf(const FileContext &context, BlockId block) {
  const auto statements = context.tree.statementsOf(block);
  return std::ranges::any_of(statements, [](const Statement &each) { return conditionOf(each).has_value(); });
}

const Jump *gotoIn(const FileContext &context, BlockId block) {
  for (const Jump &jump : context.model.jumpsIn(block, block.next()))
    if (jump.kind == JumpKind::Goto && jump.target)
      return &jump;
  return nullptr;
}

struct Next {
  BlockId block;
  bool isDirect = true; // no comment between, which may be blocks that were taken out
};

/// The block that is executed when the condition is false.
std::optional<Next> nextOf(const FileContext &context, const Jump &jump) {
  Next next{jump.block.next()};
  const BlockId last = context.model.programs[jump.program].last;
  while (next.block < last && next.block != jump.target && !hasContent(context, next.block)) {
    const Span text = context.tree.blocks[next.block].span();
    next.isDirect = next.isDirect && context.text(text).find('(') == std::string_view::npos;
    next.block = next.block.next();
  }
  return next.block < last ? std::optional(next) : std::nullopt;
}

/// The block before it asks and jumps as well: the last case of a list, written like the others.
bool isLastOfList(const FileContext &context, const Jump &jump) {
  if (jump.block == context.model.programs[jump.program].first)
    return false;
  const BlockId before(jump.block.index() - 1);
  return hasIf(context, before) && gotoIn(context, before);
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  for (const Jump &jump : context.model.jumpsOf(program)) {
    if (jump.kind != JumpKind::Goto || !jump.target || jump.target <= jump.block || !hasIf(context, jump.block))
      continue;
    const auto next = nextOf(context, jump);
    if (!next)
      continue;
    const Jump *other =
        next->block == *jump.target || hasIf(context, next->block) ? nullptr : gotoIn(context, next->block);
    const bool goesOn = next->block == *jump.target;
    if (!goesOn && !(other && !other->conditional && other->target == jump.target))
      continue;
    const Span target = context.tree.blocks[next->block].span();
    reporter.report({.message = fmt::format("{} has no effect: the program goes to `N{}` whether or not the "
                                            "condition is true",
                                            context.quoted(jump.span), context.text(jump.targetSpan)),
                     .span = jump.span,
                     .labels = {{target, goesOn ? "the next block" : "goes to the same block"}},
                     .notes = {"the jump names the wrong block, or the blocks that it should pass over are missing"}},
                    next->isDirect && !isLastOfList(context, jump) ? Severity::Warning : Severity::Info);
  }
}

} // namespace

extern const Rule jumpToNextBlock;
const Rule jumpToNextBlock{.info = {"jump-to-next-block", Category::Structure, Severity::Warning,
                                    "Reports an `IF` with a `GOTO` to the block that comes next anyway."},
                           .hooks = {.program = check}};

} // namespace feedhold::rules::jump_to_next_block
