// same-branches: two jump targets with the same statements behind them, up to the same end; a condition whose two
// outcomes do the same.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace feedhold::rules::same_branches {
namespace {

/// Shorter ones are alike by chance: a flag and a GOTO.
constexpr std::size_t kLeastBlocks = 3;

struct Branch {
  std::string text; // upper case, without blanks, sequence numbers and comments
  std::size_t blocks = 0;
};

std::string textOf(const FileContext &context, BlockId block) {
  std::string text;
  for (const Statement &statement : context.tree.statementsOf(block))
    if (!statement.nested)
      text += context.text(statement.span);
  for (const Word &word : context.tree.wordsOf(block))
    if (word.address() != 'N')
      text += context.text(word.span());
  std::erase_if(text, [](char c) { return c == ' ' || c == '\t'; });
  return toUpper(text);
}

/// From a jump target to the block that leads elsewhere, where that stands before the next label and nothing branches.
std::optional<Branch> branchAt(const FileContext &context, const Program &program, BlockId first) {
  Branch branch;
  for (BlockId block = first; block < program.last; block = block.next()) {
    if (block != first && findWord(context.tree, block, 'N'))
      return std::nullopt;
    if (context.tree.blocks[block].has(Block::kBroken))
      return std::nullopt;
    const std::string text = textOf(context, block);
    if (text.empty())
      continue;
    branch.text += text + '\n';
    ++branch.blocks;
    switch (flowAfter(context.tree, block, context.dialect)) {
    case FlowAfter::Next: break;
    case FlowAfter::MayJump: return std::nullopt;
    case FlowAfter::Jumps:
    case FlowAfter::Ends: return branch;
    }
  }
  return std::nullopt;
}

bool isTarget(const FileContext &context, BlockId block) {
  return std::ranges::any_of(context.model.jumps, [&](const Jump &jump) { return jump.target == block; });
}

/// The statements of blocks that follow one another; absent where one of them leads elsewhere or has a label.
std::optional<Branch> straight(const FileContext &context, BlockId first, BlockId end) {
  Branch branch;
  for (BlockId block = first; block < end; block = block.next()) {
    const bool isLabel = block != first && isTarget(context, block);
    if (isLabel || context.tree.blocks[block].has(Block::kBroken) ||
        flowAfter(context.tree, block, context.dialect) != FlowAfter::Next)
      return std::nullopt;
    if (const std::string text = textOf(context, block); !text.empty()) {
      branch.text += text + '\n';
      ++branch.blocks;
    }
  }
  return branch;
}

/// `IF [..] GOTO 200`, statements, `GOTO 220`, `N200`, the same statements, `N220`.
void checkCondition(const Jump &jump, ProgramId id, const FileContext &context, const Reporter &reporter) {
  if (jump.kind != JumpKind::Goto || !jump.target || *jump.target <= jump.block ||
      flowAfter(context.tree, jump.block, context.dialect) != FlowAfter::MayJump)
    return;
  const auto jumps = context.model.jumpsOf(id);
  const auto over = std::ranges::find_if(jumps, [&](const Jump &other) {
    return other.kind == JumpKind::Goto && other.target && *other.target > *jump.target && other.block > jump.block &&
           other.block.next() == *jump.target &&
           flowAfter(context.tree, other.block, context.dialect) == FlowAfter::Jumps;
  });
  if (over == jumps.end())
    return;
  const auto one = straight(context, jump.block.next(), over->block);
  const auto other = straight(context, *jump.target, *over->target);
  if (!one || !other || one->blocks == 0 || one->text != other->text)
    return;
  reporter.report({.message = "both outcomes of this condition do the same",
                   .span = context.tree.blocks[jump.block].span(),
                   .labels = {{context.tree.blocks[jump.block.next()].span(), "the one"},
                              {context.tree.blocks[*jump.target].span(), "the other"}},
                   .notes = {"one of them may be a copy that was not adapted: correct its variables or numbers",
                             "where both are right, delete the condition"}},
                  Severity::Warning);
}

void check(ProgramId id, const FileContext &context, const Reporter &reporter) {
  const Program &program = context.model.programs[id];
  for (const Jump &jump : context.model.jumpsOf(id))
    checkCondition(jump, id, context, reporter);
  std::set<BlockId> targets;
  for (const Jump &jump : context.model.jumpsOf(id))
    if (jump.kind == JumpKind::Goto && jump.target)
      targets.insert(*jump.target);
  std::map<std::string, BlockId> known;
  for (const BlockId target : targets) {
    const auto branch = branchAt(context, program, target);
    if (!branch || branch->blocks < kLeastBlocks)
      continue;
    const auto [first, isNew] = known.emplace(branch->text, target);
    if (isNew)
      continue;
    reporter.report({.message = fmt::format("this branch does the same as that in line {}",
                                            context.source.lineOf(context.tree.blocks[first->second].begin)),
                     .span = context.tree.blocks[target].span(),
                     .labels = {{context.tree.blocks[first->second].span(), "the same statements"}},
                     .notes = {"one of them may be a copy that was not adapted: variables, numbers and the index of a "
                               "table",
                               "where both are right, let both jumps lead to one of them"}});
  }
}

} // namespace

extern const Rule sameBranches;
const Rule sameBranches{.info = {"same-branches", Category::Flow, Severity::Info,
                                 "Reports two jump targets that are followed by the same statements, and a "
                                 "condition whose outcomes do the same."},
                        .hooks = {.program = check}};

} // namespace feedhold::rules::same_branches
