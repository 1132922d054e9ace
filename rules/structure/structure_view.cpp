// Dead blocks, loops and IF structures, by the text alone.
#include "rules/structure/structure_view.h"

#include "base/support/text.h"

#include <algorithm>

namespace feedhold::rules {

bool isNamed(const Program &program) { return !program.name.empty(); }

namespace {

bool isBrokenControl(const FileContext &context, BlockId block) {
  if (!context.tree.blocks[block].has(Block::kBroken))
    return false;
  const auto words = context.tree.wordsOf(block);
  const bool isOWord = context.dialect.grammar.oWords && !words.empty() && words.front().address() == 'O';
  return isOWord || std::ranges::any_of(context.tree.statementsOf(block), [](const Statement &statement) {
           return std::holds_alternative<OWord>(statement.node) || std::holds_alternative<While>(statement.node) ||
                  std::holds_alternative<Do>(statement.node) || std::holds_alternative<End>(statement.node);
         });
}

/// A subroutine without an `endsub` is told by isSubWithoutEnd.
bool findsNoPartner(const OWordUse &use, const ProgramModel &model) {
  if (!use.construct)
    return use.kind != OWordKind::Call && use.kind != OWordKind::Return;
  const Construct &construct = model.constructs[*use.construct];
  return !construct.closed && construct.kind != OWordKind::Sub;
}

} // namespace

bool isSubWithoutEnd(const Construct &construct, const FileContext &context) {
  const auto &uses = context.model.oWords;
  const std::string &label = uses[construct.parts.front()].label;
  if (construct.kind != OWordKind::Sub || construct.closed)
    return false;
  // A call finds the file by the name of the subroutine, and comes back at the `return`.
  const bool returns = std::any_of(
      uses.begin(), uses.end(), [&](const auto &use) { return use.kind == OWordKind::Return && use.label == label; });
  return !returns || !context.callGraph.isFileOf(context.file, label);
}

bool isStructureBroken(const FileContext &context, ProgramId id) {
  const ProgramModel &model = context.model;
  const Program &program = model.programs[id];
  for (BlockId block = program.first; block < program.last; block = block.next())
    if (isBrokenControl(context, block))
      return true;
  const auto isOpen = [](const Loop &loop) { return !loop.endBlock; };
  return !model.loneEndsOf(id).empty() || std::ranges::any_of(model.loopsOf(id), isOpen) ||
         std::ranges::any_of(model.oWordsIn(program.first, program.last), [&](const OWordUse &use) {
           return findsNoPartner(use, model) || (use.kind == OWordKind::Sub && use.construct &&
                                                 isSubWithoutEnd(model.constructs[*use.construct], context));
         });
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

bool isMotionCodeWithLetter(const FileContext &context, BlockId block, Span jump) {
  return std::ranges::any_of(context.tree.statementsOf(block), [&](const Statement &statement) {
    return statement.span == jump && motionCodeWithLetter(context.tree, block, statement, context.dialect);
  });
}

bool hasCondition(const FileContext &context, const Loop &loop) {
  return std::holds_alternative<While>(context.tree.statements[loop.doStatement].node);
}

std::optional<Span> endWhileAt(const FileContext &context, Span keyword) {
  constexpr std::string_view kWord = "ENDWHILE";
  for (const std::uint32_t before : {0U, 3U}) { // at END, or at WHILE
    if (keyword.begin < before || keyword.begin - before + kWord.size() > context.source.text().size())
      continue;
    const Span word{keyword.begin - before, keyword.begin - before + static_cast<std::uint32_t>(kWord.size())};
    if (toUpper(context.text(word)) == kWord)
      return word;
  }
  return std::nullopt;
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

bool mayHoldCode(const FileContext &context, BlockId block, std::string_view letters) {
  const Block &its = context.tree.blocks[block];
  const auto isRemark = [&](std::uint32_t at) {
    return std::ranges::any_of(context.tree.commentsOf(block), [&](const Comment &comment) {
      return comment.span.begin <= at && at < comment.span.end;
    });
  };
  bool isLetter = false; // one of them, and only blanks behind it
  for (std::uint32_t at = its.begin; at < its.end; ++at) {
    const char c = toUpper(context.text({at, at + 1}).front());
    if (isBlank(c) || isRemark(at))
      continue;
    if (isLetter && isDigit(c))
      return true;
    isLetter = letters.find(c) != std::string_view::npos;
  }
  return false;
}

std::vector<Contour> contoursOf(ProgramId program, const FileContext &context) {
  std::vector<Contour> contours;
  const auto jumps = context.model.jumpsOf(program);
  for (const Jump &from : jumps) {
    if (from.kind != JumpKind::ContourFrom || !from.target)
      continue;
    const auto to = std::ranges::find_if(
        jumps, [&](const Jump &jump) { return jump.kind == JumpKind::ContourTo && jump.block == from.block; });
    if (to != jumps.end() && to->target && *to->target >= *from.target)
      contours.push_back({&from, *from.target, *to->target});
  }
  return contours;
}

} // namespace feedhold::rules
