// See the header.
#include "findings/rule/dead_blocks.h"

#include "base/support/text.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace feedhold {

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

/// Where control may arrive from outside, or in a way that the text does not tell.
Entries entriesOf(const FileContext &context, ProgramId program) {
  Entries entries;
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

namespace {

/// Where a block that does not parse may have been meant to jump: `IF[#3 GT= 3] GOTO205` names the one place.  Absent:
/// it may be anywhere.
std::optional<std::vector<std::uint32_t>> unreadTargets(const FileContext &context, BlockId id) {
  std::vector<std::uint32_t> targets;
  const Block &block = context.tree.blocks[id];
  if (!block.has(Block::kBroken))
    return targets;
  if (mayNameWord(context.source, context.tree, id))
    return std::nullopt;
  const std::string text = toUpper(context.text(block.span()));
  for (std::size_t at = text.find("GO"); at != std::string::npos; at = text.find("GO", at + 2)) {
    const std::size_t first = text.find_first_not_of(" \t", at + 4);
    if (text.compare(at, 4, "GOTO") != 0 || first == std::string::npos)
      return std::nullopt;
    const std::size_t end = std::min(text.find_first_not_of("0123456789", first), text.size());
    constexpr std::size_t kMostDigits = 9;
    const bool goesOn = end < text.size() && std::string_view(".#[+-*/").find(text[end]) != std::string_view::npos;
    if (end == first || end - first > kMostDigits || goesOn)
      return std::nullopt;
    targets.push_back(static_cast<std::uint32_t>(std::stoul(text.substr(first, end - first))));
  }
  return targets;
}

/// The blocks to which control may come: along blocks and jumps that are themselves reached.
class ReachedBlocks {
public:
  ReachedBlocks(const FileContext &context, ProgramId id)
      : context_(context), program_(context.model.programs[id]),
        reached_(program_.last.index() - program_.first.index()) {
    for (const SequenceNumber &label : context.model.sequenceNumbersOf(id))
      labels_[label.number].push_back(label.block);
    for (const Loop &loop : context.model.loopsOf(id))
      if (loop.endBlock)
        endOfDo_.emplace(loop.doBlock.index(), *loop.endBlock);
    const Entries entries = entriesOf(context, id);
    open_.push_back(program_.first);
    for (BlockId block = program_.first; block < program_.last; block = block.next())
      if (continuesIf(context, block) || isReachedByOWord(context, block) || isEntry(context, entries, block))
        open_.push_back(block);
    while (!open_.empty()) {
      const BlockId block = open_.back();
      open_.pop_back();
      follow(block);
    }
  }

  bool contains(BlockId block) const { return reached_[block.index() - program_.first.index()]; }

private:
  void follow(BlockId from) {
    for (BlockId block = from; block < program_.last && !contains(block); block = block.next()) {
      reached_[block.index() - program_.first.index()] = true;
      if (!isRead(context_.tree.blocks[block]))
        continue;
      // An END is reached from its DO, when that is.
      if (const auto end = endOfDo_.find(block.index()); end != endOfDo_.end())
        open_.push_back(end->second);
      for (const Jump &jump : context_.model.jumpsIn(block, block.next()))
        if (jump.kind != JumpKind::CallAt)
          addTargets(jump);
      addUnread(block);
      if (leavesForGood(context_, block))
        return;
    }
  }
  void addUnread(BlockId block) {
    if (const auto targets = unreadTargets(context_, block))
      for (const std::uint32_t number : *targets)
        addLabel(number);
    else
      addAllLabels();
  }
  void addLabel(std::uint32_t number) {
    if (const auto label = labels_.find(number); label != labels_.end())
      open_.insert(open_.end(), label->second.begin(), label->second.end());
  }
  void addTargets(const Jump &jump) {
    if (const auto number = targetNumber(jump)) {
      addLabel(*number);
    } else if (jump.computed) {
      addAllLabels();
    }
  }
  void addAllLabels() {
    if (!std::exchange(hasAllLabels_, true))
      for (const auto &[number, blocks] : labels_)
        open_.insert(open_.end(), blocks.begin(), blocks.end());
  }

  const FileContext &context_;
  const Program &program_;
  std::vector<bool> reached_;
  std::unordered_map<std::uint32_t, std::vector<BlockId>> labels_;
  std::unordered_map<std::uint32_t, BlockId> endOfDo_;
  std::vector<BlockId> open_;
  bool hasAllLabels_ = false;
};

} // namespace

DeadBlocks::DeadBlocks(const FileContext &context, ProgramId id) {
  const Program &program = context.model.programs[id];
  const ReachedBlocks reached(context, id);
  BlockId ender = program.first;
  bool inRun = false;
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    if (!isRead(context.tree.blocks[block]))
      continue;
    if (reached.contains(block)) {
      inRun = false;
      if (leavesForGood(context, block))
        ender = block;
    } else if (hasContent(context, block)) {
      if (inRun)
        runs_.back().last = block;
      else
        runs_.push_back({ender, block, block});
      inRun = true;
    }
  }
}

bool DeadBlocks::contains(BlockId block) const {
  const auto behind = std::ranges::upper_bound(runs_, block, {}, &Run::first);
  return behind != runs_.begin() && block <= std::prev(behind)->last;
}

bool NeverExecuted::contains(BlockId block) {
  if (context_.model.programs.empty())
    return false;
  const ProgramId program = context_.model.programOf(block);
  return dead_.try_emplace(program.index(), context_, program).first->second.contains(block);
}

} // namespace feedhold
