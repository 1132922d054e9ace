// Dead blocks, loops and IF structures, by the text alone.
#include "rules/structure/structure_view.h"

#include <algorithm>
#include <set>
#include <unordered_map>
#include <unordered_set>

namespace feedhold::rules {

namespace {

/// Which sequence numbers of a program control may be sent to.
struct Entries {
  bool any = false; // a computed jump: every one
  std::unordered_set<std::uint32_t> numbers;
};

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
  // A block that does not parse may jump anywhere.
  const Program &blocks = context.model.programs[program];
  for (BlockId block = blocks.first; block < blocks.last; block = block.next())
    entries.any = entries.any || context.tree.blocks[block].has(Block::kBroken);
  addReturns(entries, context, program);
  addStarts(entries, context, program);
  return entries;
}

/// Control never reaches the block behind this one.
bool leavesForGood(const FileContext &context, BlockId block) {
  if ((context.tree.blocks[block].flags & (Block::kSkip | Block::kSkipInside)) != 0)
    return false;
  const FlowAfter flow = flowAfter(context.tree, block, context.dialect);
  return flow == FlowAfter::Jumps || flow == FlowAfter::Ends;
}

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

bool isNamed(const Program &program) { return !program.name.empty(); }

DeadBlocks::DeadBlocks(const FileContext &context, ProgramId id) {
  const Program &program = context.model.programs[id];
  const Entries entries = entriesOf(context, id);
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

std::optional<BlockId> openEnd(const FileContext &context, ProgramId id) {
  const Program &program = context.model.programs[id];
  std::optional<BlockId> last;
  for (BlockId block = program.first; block < program.last; block = block.next())
    if (isRead(context.tree.blocks[block]) && hasContent(context, block))
      last = block;
  if (!last || leavesForGood(context, *last) || DeadBlocks(context, id).contains(*last))
    return std::nullopt;
  const bool endless = std::ranges::any_of(context.model.loopsOf(id), [&](const Loop &loop) {
    return loop.endBlock == last && !hasCondition(context, loop);
  });
  // A program that every job calls last, and that ends it by M30.
  const bool callEnds = std::ranges::any_of(context.model.callsIn(*last, last->next()), [&](const Call &call) {
    const auto callee = context.callGraph.callee(context.file, call);
    return callee && !context.callGraph.model(callee->file).programs[callee->program].returns;
  });
  return endless || callEnds ? std::nullopt : last;
}

BranchBlocks::BranchBlocks(const ProgramModel &model) {
  for (const Construct &construct : model.constructs)
    if (construct.kind == OWordKind::If && construct.closed) {
      const BlockId end = model.oWords[construct.parts.back()].block;
      reach_.emplace_back(model.oWords[construct.parts.front()].block,
                          reach_.empty() ? end : std::max(reach_.back().second, end));
    }
}

bool BranchBlocks::contains(BlockId block) const {
  const auto behind = std::ranges::lower_bound(reach_, block, {}, &std::pair<BlockId, BlockId>::first);
  return behind != reach_.begin() && block < std::prev(behind)->second;
}

bool isInside(const Loop &loop, BlockId block) {
  return loop.endBlock && loop.doBlock < block && block <= *loop.endBlock;
}

bool hasCondition(const FileContext &context, const Loop &loop) {
  return std::holds_alternative<While>(context.tree.statements[loop.doStatement].node);
}

IfStructures ifStructures(const FileContext &context, ProgramId id) {
  const Program &program = context.model.programs[id];
  IfStructures result;
  std::vector<std::size_t> open;
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    for (const Statement &statement : context.tree.statementsOf(block)) {
      const StatementId statementId = context.tree.idOf(statement);
      const auto *head = std::get_if<If>(&statement.node);
      const bool closes = std::holds_alternative<EndIf>(statement.node);
      if (head && head->action == IfAction::Lines) {
        open.push_back(result.structures.size());
        result.structures.push_back({statementId, {}, false});
      } else if (closes || std::holds_alternative<Else>(statement.node) ||
                 std::holds_alternative<ElseIf>(statement.node)) {
        if (open.empty()) {
          result.strays.push_back(statementId);
          continue;
        }
        result.structures[open.back()].parts.push_back(statementId);
        result.structures[open.back()].closed = closes;
        if (closes)
          open.pop_back();
      }
    }
  }
  return result;
}

std::vector<SequenceNumber> sortedSequenceNumbers(const ProgramModel &model, ProgramId id) {
  const auto inText = model.sequenceNumbersOf(id);
  std::vector<SequenceNumber> sorted(inText.begin(), inText.end());
  std::ranges::stable_sort(sorted, {}, &SequenceNumber::number);
  return sorted;
}

LoopNest::LoopNest(std::span<const Loop> loops) : loops_(loops) {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    std::erase_if(open, [&](std::size_t outer) { return !isInside(loops[outer], loops[i].doBlock); });
    outer_.push_back(open.empty() ? kNone : open.back());
    open.push_back(i);
  }
}

std::vector<const Loop *> LoopNest::around(BlockId block) const {
  const auto behind = std::ranges::lower_bound(loops_, block, {}, &Loop::doBlock);
  std::vector<const Loop *> found;
  // A loop around the block is the last one begun before it, or one that was open when that one began.
  std::size_t at = behind == loops_.begin() ? kNone : static_cast<std::size_t>(behind - loops_.begin()) - 1;
  for (; at != kNone; at = outer_[at])
    if (isInside(loops_[at], block))
      found.push_back(&loops_[at]);
  return found;
}

} // namespace feedhold::rules
