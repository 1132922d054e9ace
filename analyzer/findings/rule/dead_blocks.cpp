// See the header.
#include "findings/rule/dead_blocks.h"

#include <algorithm>
#include <set>
#include <unordered_map>
#include <unordered_set>

namespace feedhold {

namespace {

using Entries = DeadBlocks::Entries;

void addTarget(Entries &entries, const Jump &jump) {
  const auto number = targetNumber(jump);
  if (number)
    entries.numbers.insert(*number);
  else
    entries.any = entries.any || jump.computed;
}

/// `M99 P n` of the programs that this one calls comes back to one of its blocks.
void addReturns(Entries &entries, const FileContext &context, ProgramId program) {
  std::set<ProgramRef> seen;
  for (const Call &call : context.model.callsOf(program)) {
    for (const ProgramRef &callee : context.callGraph.candidates(context.file, call)) {
      if (!seen.insert(callee).second)
        continue;
      for (const Jump &jump : context.callGraph.model(callee.file).jumpsOf(callee.program))
        if (jump.kind == JumpKind::ReturnTo)
          addTarget(entries, jump);
    }
  }
}

/// `M98 P.. Q n` of a caller starts in the middle.
void addStarts(Entries &entries, const FileContext &context, ProgramId program) {
  for (const auto &[file, callId] : context.callGraph.callers({context.file, program})) {
    const ProgramModel &model = context.callGraph.model(file);
    const BlockId block = model.calls[callId].block;
    for (const Jump &jump : model.jumpsIn(block, block.next()))
      if (jump.kind == JumpKind::CallAt)
        addTarget(entries, jump);
  }
}

Entries entriesOf(const FileContext &context, ProgramId program) {
  Entries entries;
  for (const Jump &jump : context.model.jumpsOf(program))
    if (jump.kind != JumpKind::CallAt)
      addTarget(entries, jump);
  // `G65 H80 P n` and its like jump, too.
  entries.any = entries.any || std::ranges::any_of(context.model.callsOf(program),
                                                   [](const Call &call) { return call.kind == CallKind::MacroA; });
  addReturns(entries, context, program);
  addStarts(entries, context, program);
  return entries;
}

} // namespace

bool leavesForGood(const FileContext &context, BlockId block) {
  if ((context.tree.blocks[block].flags & (Block::kSkip | Block::kSkipInside)) != 0)
    return false;
  const FlowAfter flow = flowAfter(context.tree, block, context.dialect);
  return flow == FlowAfter::Jumps || flow == FlowAfter::Ends;
}

namespace {

/// An o-word that others of its label lead to; behind `endsub` goes on what passes over the subroutine.
bool isReachedByOWord(const FileContext &context, BlockId block) {
  const auto reached = [](const OWordUse &use) {
    return use.kind != OWordKind::Call && use.kind != OWordKind::Break && use.kind != OWordKind::Continue &&
           use.kind != OWordKind::Return;
  };
  const auto ends = [](const OWordUse &use) { return use.kind == OWordKind::EndSub; };
  const BlockId before(block.index() == 0 ? 0 : block.index() - 1);
  return std::ranges::any_of(context.model.oWordsIn(block, block.next()), reached) ||
         std::ranges::any_of(context.model.oWordsIn(before, block), ends);
}

/// ELSE and ENDIF are reached from their IF, whatever stands before them.
bool continuesIf(const FileContext &context, BlockId block) {
  return std::ranges::any_of(context.tree.statementsOf(block), [](const Statement &statement) {
    return std::holds_alternative<Else>(statement.node) || std::holds_alternative<ElseIf>(statement.node) ||
           std::holds_alternative<EndIf>(statement.node);
  });
}

bool isEntry(const FileContext &context, const Entries &entries, BlockId block) {
  const Word *number = findWord(context.tree, block, 'N');
  if (!number)
    return false;
  return entries.any || !number->integer() || entries.numbers.contains(*number->integer());
}

} // namespace

bool isRead(const Block &block) { return (block.flags & (Block::kPercent | Block::kLeader | Block::kAfterEnd)) == 0; }

bool hasContent(const FileContext &context, BlockId block) {
  return !context.tree.statementsOf(block).empty() ||
         std::ranges::any_of(context.tree.wordsOf(block), [](const Word &word) {
           return word.address() != 'N' && word.address() != 'O' && word.form() != WordForm::Name;
         });
}

/// A block that does not parse may jump anywhere, if it is executed.
bool mayJumpUnread(const FileContext &context, const Program &program, const DeadBlocks &dead) {
  for (BlockId block = program.first; block < program.last; block = block.next())
    if (context.tree.blocks[block].has(Block::kBroken) && !dead.contains(block))
      return true;
  return false;
}

DeadBlocks::DeadBlocks(const FileContext &context, ProgramId id) {
  Entries entries = entriesOf(context, id);
  find(context, id, entries);
  if (!mayJumpUnread(context, context.model.programs[id], *this))
    return;
  runs_.clear();
  entries.any = true;
  find(context, id, entries);
}

void DeadBlocks::find(const FileContext &context, ProgramId id, const DeadBlocks::Entries &entries) {
  const Program &program = context.model.programs[id];
  std::unordered_map<std::uint32_t, BlockId> doOfEnd;
  for (const Loop &loop : context.model.loopsOf(id))
    if (loop.endBlock)
      doOfEnd.emplace(loop.endBlock->index(), loop.doBlock);
  bool isDead = false; // control does not come from `ender`, the last block that it ran
  BlockId ender = program.first;
  bool inRun = false;
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    if (!isRead(context.tree.blocks[block]))
      continue;
    // An END is reached from its DO, when that is.
    const auto loop = doOfEnd.find(block.index());
    const bool endsLoop = loop != doOfEnd.end() && !contains(loop->second);
    if (endsLoop || continuesIf(context, block) || isReachedByOWord(context, block) ||
        isEntry(context, entries, block)) {
      isDead = false;
      inRun = false;
    } else if (isDead && hasContent(context, block)) {
      if (inRun)
        runs_.back().last = block;
      else
        runs_.push_back({ender, block, block});
      inRun = true;
    }
    if (!isDead && leavesForGood(context, block)) {
      isDead = true;
      ender = block;
    }
  }
}

bool DeadBlocks::contains(BlockId block) const {
  const auto behind = std::ranges::upper_bound(runs_, block, {}, &Run::first);
  return behind != runs_.begin() && block <= std::prev(behind)->last;
}

} // namespace feedhold
