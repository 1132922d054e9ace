// Lowering of blocks: words, calls, returns and ends.  Order: block skip, words, statements, calls, return or end.
#include "meaning/cfg/lowering.h"

#include "base/support/text.h"
#include "language/model/block_facts.h"
#include "language/model/contours.h"
#include "language/model/unread_blocks.h"
#include "meaning/cfg/computed_repeats.h"

#include <algorithm>

namespace feedhold {

namespace {

constexpr std::uint16_t kUnreadInPart = Block::kBroken | Block::kCommentTail;

} // namespace

/// A control that tolerates a stray `)` reads the tail of a comment as words of the block, which may change any of
/// them; where the tail is nothing but the `)`, it reads the block as it is written.
bool Lowering::isUnread(BlockId id) const {
  const Block &block = tree_.blocks[id];
  const std::span<const Statement> statements = tree_.statementsOf(id);
  return block.has(Block::kBroken) ||
         (block.has(Block::kCommentTail) && std::ranges::any_of(statements, [&](const Statement &each) {
            return std::holds_alternative<BrokenStatement>(each.node) && !isStrayParenthesis(each);
          }));
}

void Lowering::block(BlockId id) {
  cfg_.blockNode[id.index()] = end();
  const Block &block = tree_.blocks[id];
  const bool tapeMark = block.has(Block::kPercent) && tree_.wordsOf(id).empty();
  const bool isSilent =
      isEmpty(tree_, id) && (block.flags & kUnreadInPart) == 0 && !abortsProgram(source_, tree_, id, dialect_);
  if (block.has(Block::kLeader) || tapeMark || isSilent)
    return;
  block_ = id;
  if (isPlain(id))
    plainBlock(id);
  else
    wholeBlock(id);
  // Jumps arrive at a node of the block itself: that of the next block may be the head of a loop, or behind a gate.
  if (end() == cfg_.nodeOf(id) && !model_.sequenceNumbersIn(id, id.next()).empty())
    emit(Pass{});
}

void Lowering::plainBlock(BlockId id) {
  const bool data = tree_.blocks[id].has(Block::kData);
  executeWords(WordChoice::Always, [&](const Word &word) {
    return data || word.has(Word::kComma) || (word.address() != 'N' && word.address() != 'O' && word.address() != '<');
  });
}

/// A node for the words of the block for which isOwn(word) holds, where there is one.
template <typename IsOwn> void Lowering::executeWords(WordChoice which, IsOwn &&isOwn) {
  const std::span<const Word> all = tree_.wordsOf(block_);
  ExecuteWords execute{.which = which};
  std::size_t count = 0;
  for (const Word &word : all)
    if (isOwn(word)) {
      ++count;
      execute.traits.add(word, codeOf(word, dialect_));
    }
  execute.isWholeBlock = count == all.size();
  if (count > 0)
    emit(execute);
}

/// Nothing but words of which none calls, jumps, returns or ends: nearly every block that is not of a macro.
bool Lowering::isPlain(BlockId id) {
  while (nextCall_ < model_.calls.size() && model_.calls[CallId(nextCall_)].block < id)
    ++nextCall_;
  while (nextJump_ < model_.jumps.size() && model_.jumps[nextJump_].block < id)
    ++nextJump_;
  const Block &block = tree_.blocks[id];
  constexpr std::uint16_t kSpecial = Block::kSkip | kUnreadInPart | Block::kSkipInside;
  if ((block.flags & kSpecial) != 0 || block.firstStatement != tree_.blocks[id.next()].firstStatement)
    return false;
  if (nextCall_ < model_.calls.size() && model_.calls[CallId(nextCall_)].block == id)
    return false;
  if (abortsProgram(source_, tree_, id, dialect_))
    return false;
  if (nextJump_ < model_.jumps.size() && model_.jumps[nextJump_].block == id)
    return false;
  for (const Word &word : tree_.wordsOf(id)) {
    const Code *code = word.address() == 'M' ? codeOf(word, dialect_) : nullptr;
    if (code &&
        (code->role == CodeRole::Return || code->role == CodeRole::ProgramEnd || code->role == CodeRole::JumpOnInput))
      return false;
  }
  return true;
}

void Lowering::wholeBlock(BlockId id) {
  const Block &head = tree_.blocks[id];
  const BlockWords blockWords(tree_, model_, dialect_, id);
  std::optional<NodeId> skip;
  if (head.has(Block::kSkip))
    skip = emit(BlockSkip{head.skipLevel, end()});
  if (abortsProgram(source_, tree_, id, dialect_)) {
    stop(AlarmKind::ProgramAborted);
  } else if (isUnread(id)) {
    brokenBlock(blockWords);
  } else {
    for (const Statement &statement : tree_.statementsOf(id))
      if (const auto digit = statement.nested ? std::nullopt : motionCodeWithLetter(tree_, id, statement, dialect_))
        emit(Havoc{kUnreadMotionCodes[*digit]});
    words(blockWords);
    statements();
    calls(blockWords);
    contour();
    jumpOnInput();
    ending(blockWords);
  }
  closeSkip(skip);
  leaveOutDo(skip);
}

/// The control stops with an alarm at what it cannot read, or else it may do anything; jumps, loops and ends that could
/// be read may or may not take place.
void Lowering::brokenBlock(const BlockWords &words) {
  const bool isApart = leavesModalCalls(source_, tree_, dialect_, block_);
  const std::string_view reason = isApart ? kUnreadWithoutCall : kUnreadBlock;
  if (!mayNameWord(source_, tree_, block_))
    emit(HavocVariables{reason});
  else if (namesAxesAlone(source_, tree_, dialect_, block_))
    emit(Havoc{kUnreadMovement});
  else
    emit(Havoc{reason});
  flowStatements();
  if (!words.ending())
    return;
  const NodeId maybe = emitTest(std::nullopt);
  leave(words);
  setNext(maybe, end());
}

/// With a `/` in mid-block: the words before it, or all.
void Lowering::words(const BlockWords &words) {
  const auto isOf = [&words](WordChoice which) {
    return [&words, which](const Word &word) { return words.belongsTo(word, which); };
  };
  const std::span<const Word> all = tree_.wordsOf(block_);
  const bool skipped = std::any_of(all.begin(), all.end(), [&](const Word &word) {
    return !words.belongsTo(word, WordChoice::Always) && words.belongsTo(word, WordChoice::WithSkipped);
  });
  if (!skipped)
    return executeWords(WordChoice::Always, isOf(WordChoice::Always));
  const NodeId skip = emit(BlockSkip{levelOf(innerSkip()), end()});
  const NodeId whole = end();
  executeWords(WordChoice::WithSkipped, isOf(WordChoice::WithSkipped));
  closeSkip(skip);
  executeWords(WordChoice::Always, isOf(WordChoice::Always));
  setNext(whole, end());
}

void Lowering::calls(const BlockWords &words) {
  for (const Call &each : words.calls()) {
    if (each.kind == CallKind::OWord) {
      call(each);
      continue;
    }
    const Word &code = tree_.words[each.code];
    if (code.has(Word::kAfterThen))
      continue;
    const std::optional<NodeId> skip = openInnerSkip(code.span());
    call(each);
    closeSkip(skip);
  }
}

void Lowering::call(const Call &call) {
  if (call.kind == CallKind::MacroA) {
    operationOfMacroA(call);
    return;
  }
  const auto index = static_cast<std::size_t>(&call - &model_.calls[CallId(0)]);
  const std::optional<ExpressionId> times = computedRepeats(tree_, call);
  if (!times) {
    emit(CallProgram{CallId(index)});
    return;
  }
  const CounterId counter(cfg_.counters++);
  emit(StartCount{counter, *times});
  const NodeId head = emit(CountDown{counter, end().next()});
  setNext(emit(CallProgram{CallId(index)}), head);
  setNext(head, end());
}

/// H80 jumps, H81 to H86 jump on a comparison; the others compute and are left to the call itself.
void Lowering::operationOfMacroA(const Call &call) {
  const auto index = static_cast<std::size_t>(&call - &model_.calls[CallId(0)]);
  const Word *operation = findWord(tree_, block_, 'H');
  const Word *target = findWord(tree_, block_, 'P');
  const std::uint32_t number = operation ? operation->integer().value_or(0) : 0;
  if (number < 80 || number > 86 || !target)
    emit(CallProgram{CallId(index)});
  else if (number == 80)
    goTo(jumpTo(*target));
  else
    mayGoTo(jumpTo(*target));
}

/// `M96 P10 Q5`: the input is the machine's.
void Lowering::jumpOnInput() {
  const Word *target = findWord(tree_, block_, 'P');
  if (target && findCode(tree_, block_, dialect_, CodeRole::JumpOnInput))
    mayGoTo(jumpTo(*target));
}

Jump Lowering::jumpTo(const Word &target) const {
  Jump jump{JumpKind::Goto, model_.programOf(block_), block_, target.span(), target.span(), {}, {}, {}};
  if (target.isNumber())
    jump.number = target.number();
  else if (target.form() == WordForm::Expression)
    jump.computed = target.expression();
  if (const std::optional<std::uint32_t> label = targetNumber(jump))
    jump.target = findSequence(model_, jump.program, *label, block_);
  return jump;
}

void Lowering::mayGoTo(const Jump &jump) {
  const NodeId test = emitTest(std::nullopt);
  goTo(jump);
  setNext(test, end());
}

/// Behind the cycle the program goes on after the contour: manuals say so of roughing cycles with a contour directly
/// behind them.
bool Lowering::passes(const ContourBlocks &contour) const {
  BlockId next = block_.next();
  while (next < contour.first && isEmpty(tree_, next))
    next = next.next();
  return next == contour.first && !findAction(tree_, block_, dialect_, {CodeAction::FinishContour}) &&
         isPlainContour(tree_, model_, dialect_, contour, ContourCodes::OfCompensation);
}

/// A cycle over the blocks P to Q: they are its data, and where they lie ahead the program goes on behind them.
/// Analyses of the text take both ways, over them and through them as if they were read; so do all others where a
/// contour has more than a path.
void Lowering::contour() {
  const auto contour = contourAt(model_, block_);
  if (!contour)
    return;
  const BlockId behind = contour->last.next();
  const bool computes = tree_.blocks[contour->first].firstStatement != tree_.blocks[behind].firstStatement;
  if (computes)
    emit(Havoc{"a contour with macro statements"});
  if (contour->first > block_) {
    const NodeId test = emitTest(std::nullopt);
    std::get<Test>(cfg_.nodes[test].instruction).passesContour = passes(*contour);
    openJumps_.push_back({test, Edge::Taken, behind});
  }
}

void Lowering::ending(const BlockWords &words) {
  if (!words.ending() || words.ending()->has(Word::kAfterThen))
    return;
  const std::optional<NodeId> skip = openInnerSkip(words.ending()->span());
  leave(words);
  closeSkip(skip);
}

void Lowering::leave(const BlockWords &words) {
  if (!words.endingReturns()) {
    emitLast(EndProgram{words.ending()->tenths() == 20 ? ProgramEnd::M02 : ProgramEnd::M30});
    return;
  }
  const Word *target = findWord(tree_, block_, 'P');
  if (target && dialect_.behaviour.returnTargetIsLocal) {
    goTo(jumpTo(*target));
    return;
  }
  emitLast(ReturnFromProgram{target ? std::optional(tree_.idOf(*target)) : std::nullopt, std::nullopt});
}

/// `IF [..] THEN S900`, `[..] M99 P10`.
void Lowering::wordsUnderCondition(std::optional<ExpressionId> condition) {
  const BlockWords words(tree_, model_, dialect_, block_);
  const NodeId test = emitTest(condition);
  executeWords(WordChoice::UnderCondition,
               [&](const Word &word) { return words.belongsTo(word, WordChoice::UnderCondition); });
  for (const Call &each : words.calls())
    if (each.kind != CallKind::OWord && tree_.words[each.code].has(Word::kAfterThen))
      call(each);
  if (words.ending() && words.ending()->has(Word::kAfterThen))
    leave(words);
  setNext(test, end());
}

/// What stands behind a `/` in mid-block: there the operator's switch decides.
std::optional<NodeId> Lowering::openInnerSkip(Span part) {
  if (!tree_.blocks[block_].has(Block::kSkipInside))
    return std::nullopt;
  const Span slash = innerSkip();
  return part.begin > slash.begin ? std::optional(emit(BlockSkip{levelOf(slash), end()})) : std::nullopt;
}

void Lowering::closeSkip(std::optional<NodeId> skip) {
  if (skip)
    std::get<BlockSkip>(cfg_.nodes[*skip].instruction).skipped = end();
}

/// The first `/` that does not stand at the head of the block.
Span Lowering::innerSkip() const {
  const Block &block = tree_.blocks[block_];
  std::uint32_t head = block.end;
  for (const Word &word : tree_.wordsOf(block_))
    if (word.address() != 'N')
      head = std::min(head, word.span().begin);
  for (const Statement &statement : tree_.statementsOf(block_))
    head = std::min(head, statement.span.begin);
  const auto first = std::upper_bound(tree_.skips.begin(), tree_.skips.end(), head,
                                      [](std::uint32_t at, Span skip) { return at < skip.begin; });
  return first == tree_.skips.end() ? Span{block.end, block.end} : *first;
}

std::uint8_t Lowering::levelOf(Span slash) const {
  const std::string_view text = source_.text(slash);
  return text.size() > 1 && isDigit(text.back()) ? static_cast<std::uint8_t>(text.back() - '0') : 1;
}

} // namespace feedhold
