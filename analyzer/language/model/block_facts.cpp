// What the codes of one block mean together.
#include "language/model/block_facts.h"

#include "base/support/text.h"
#include "language/dialect/text_keywords.h"

#include <algorithm>

namespace feedhold {

const Code *codeOf(const Word &word, const Dialect &dialect) {
  if (!word.isCode())
    return nullptr;
  const std::optional<std::uint16_t> tenths = word.tenths();
  if (!tenths)
    return nullptr;
  return word.address() == 'G' ? findGCode(dialect, *tenths) : findMCode(dialect, *tenths);
}

const Word *findCode(const SyntaxTree &tree, BlockId block, const Dialect &dialect, CodeRole role) {
  for (const Word &word : tree.wordsOf(block))
    if (const Code *code = codeOf(word, dialect); code && code->role == role)
      return &word;
  return nullptr;
}

const Word *findAction(const SyntaxTree &tree, BlockId block, const Dialect &dialect,
                       std::initializer_list<CodeAction> actions) {
  for (const Word &word : tree.wordsOf(block))
    if (const Code *code = codeOf(word, dialect);
        code && std::find(actions.begin(), actions.end(), code->action) != actions.end())
      return &word;
  return nullptr;
}

const Word *findTurningCycle(const SyntaxTree &tree, BlockId block, const Dialect &dialect) {
  for (const Word &word : tree.wordsOf(block))
    if (const Code *code = codeOf(word, dialect); code && isTurningCycle(code->action))
      return &word;
  return nullptr;
}

const Word *findWord(const SyntaxTree &tree, BlockId block, char address) {
  for (const Word &word : tree.wordsOf(block))
    if (word.address() == address && !word.has(Word::kComma))
      return &word;
  return nullptr;
}

namespace {

bool isMacroCall(CodeRole role) {
  return role == CodeRole::MacroCall || role == CodeRole::ModalCall || role == CodeRole::ModalCallEach;
}

bool isCodeCall(const Word &word, const Dialect &dialect) {
  const auto tenths = word.isNumber() ? word.tenths() : std::nullopt;
  return tenths && findCodeCall(dialect, word.address(), *tenths);
}

} // namespace

bool passesArguments(const SyntaxTree &tree, BlockId block, const Dialect &dialect) {
  const auto words = tree.wordsOf(block);
  return std::any_of(words.begin(), words.end(), [&](const Word &word) {
    const Code *code = codeOf(word, dialect);
    return (code && isMacroCall(code->role)) || isCodeCall(word, dialect);
  });
}

bool meansOwnWords(const Word &word, const Dialect &dialect) {
  if (isCodeCall(word, dialect))
    return true;
  if (!word.isCode())
    return false;
  const Code *code = codeOf(word, dialect);
  return !code || isMacroCall(code->role) || code->role == CodeRole::DataSetting || code->role == CodeRole::OwnWords;
}

bool meansOwnWords(const SyntaxTree &tree, BlockId block, const Dialect &dialect) {
  const auto words = tree.wordsOf(block);
  return std::any_of(words.begin(), words.end(), [&](const Word &word) { return meansOwnWords(word, dialect); });
}

namespace {

/// `#3000 = n`: the program stops here with an alarm.
bool raisesAlarm(const SyntaxTree &tree, const Statement &statement, const Dialect &dialect) {
  const auto *assignment = std::get_if<Assignment>(&statement.node);
  const auto number = assignment ? variableNumber(tree, assignment->target) : std::nullopt;
  return number && raisesAlarm(dialect, *number);
}

FlowAfter flowOf(OWordKind kind) {
  switch (kind) {
  case OWordKind::Call: return FlowAfter::Next;
  case OWordKind::EndSub: return FlowAfter::Ends;
  case OWordKind::Return:
  case OWordKind::Break:
  case OWordKind::Continue: return FlowAfter::Jumps;
  case OWordKind::Sub:
  case OWordKind::If:
  case OWordKind::ElseIf:
  case OWordKind::Else:
  case OWordKind::EndIf:
  case OWordKind::While:
  case OWordKind::EndWhile:
  case OWordKind::Do:
  case OWordKind::Repeat:
  case OWordKind::EndRepeat: return FlowAfter::MayJump;
  }
  return FlowAfter::MayJump;
}

FlowAfter flowOfStatement(const SyntaxTree &tree, const Statement &statement, const Dialect &dialect) {
  if (std::holds_alternative<Goto>(statement.node))
    return FlowAfter::Jumps;
  if (raisesAlarm(tree, statement, dialect))
    return FlowAfter::Ends;
  if (const auto *oWord = std::get_if<OWord>(&statement.node))
    return flowOf(oWord->kind);
  const bool branches = std::holds_alternative<If>(statement.node) || std::holds_alternative<While>(statement.node) ||
                        std::holds_alternative<End>(statement.node) || std::holds_alternative<Do>(statement.node) ||
                        std::holds_alternative<Else>(statement.node) ||
                        std::holds_alternative<ElseIf>(statement.node) ||
                        std::holds_alternative<ConditionalWords>(statement.node) ||
                        std::holds_alternative<BrokenStatement>(statement.node);
  return branches ? FlowAfter::MayJump : FlowAfter::Next;
}

bool ends(CodeRole role) { return role == CodeRole::ProgramEnd || role == CodeRole::Return; }

} // namespace

bool abortsProgram(const SourceFile &source, const SyntaxTree &tree, BlockId block, const Dialect &dialect) {
  if (!dialect.grammar.oWords)
    return false;
  std::string_view last;
  for (const Comment &comment : tree.commentsOf(block))
    if (const std::string_view text = source.text(comment.span); text.starts_with('('))
      last = text;
  const std::size_t text = last.find_first_not_of(" \t", 1);
  return text != std::string_view::npos && beginsUpper(last.substr(text), "ABORT,") &&
         std::ranges::none_of(tree.statementsOf(block),
                              [](const Statement &statement) { return std::holds_alternative<OWord>(statement.node); });
}

std::optional<unsigned> motionCodeWithLetter(const SyntaxTree &tree, BlockId block, const Statement &statement,
                                             const Dialect &dialect) {
  constexpr std::uint32_t kLength = 3; // `GO1`
  const auto *jump = std::get_if<Goto>(&statement.node);
  const auto target = jump && jump->target ? literalValue(tree, *jump->target) : std::nullopt;
  constexpr double kLast = 3; // of G00 to G03
  if (!target || statement.span.size() != kLength || target->toDouble() > kLast)
    return std::nullopt;
  const bool isMoved = std::ranges::any_of(tree.wordsOf(block), [&](const Word &word) {
    return formatOf(dialect, word.address()).kind == AddressKind::Length;
  });
  return isMoved ? std::optional(static_cast<unsigned>(target->toDouble())) : std::nullopt;
}

FlowAfter flowAfter(const SyntaxTree &tree, BlockId block, const Dialect &dialect) {
  FlowAfter flow = FlowAfter::Next;
  for (const Statement &statement : tree.statementsOf(block))
    if (!statement.nested)
      flow = std::max(flow, motionCodeWithLetter(tree, block, statement, dialect)
                                ? FlowAfter::MayJump
                                : flowOfStatement(tree, statement, dialect));
  for (const Word &word : tree.wordsOf(block)) {
    const Code *code = codeOf(word, dialect);
    if (!code || !ends(code->role))
      continue;
    const bool conditional = word.has(Word::kAfterThen) || word.has(Word::kAfterSkip);
    flow = std::max(flow, conditional ? FlowAfter::MayJump : FlowAfter::Ends);
  }
  // A block that the operator may skip may be followed by the next one whatever it does.
  if (tree.blocks[block].has(Block::kSkip) && flow > FlowAfter::MayJump)
    return FlowAfter::MayJump;
  return flow;
}

bool mayNameWord(const SourceFile &source, const SyntaxTree &tree, BlockId id) {
  const Block &block = tree.blocks[id];
  const std::span<const Comment> comments = tree.commentsOf(id);
  const auto isCode = [&](std::uint32_t at) {
    return std::none_of(comments.begin(), comments.end(),
                        [&](const Comment &comment) { return comment.span.begin <= at && at < comment.span.end; });
  };
  char address = ' ';  // a letter that no other letter stands before
  bool isName = false; // the last letter had one before it
  for (std::uint32_t at = block.begin; at < block.end; ++at) {
    const char c = toUpper(source.text({at, at + 1}).front());
    if (c == ' ' || c == '\t' || !isCode(at))
      continue;
    if (c >= 'A' && c <= 'Z') {
      isName = isName || address != ' ';
      address = c;
      continue;
    }
    const bool isValue = isDigit(c) || c == '#' || c == '[' || c == '-' || c == '+' || c == '.';
    if (address != ' ' && address != 'N' && !isName && isValue)
      return true;
    address = ' ';
    isName = false;
  }
  return false;
}

bool isEmpty(const SyntaxTree &tree, BlockId block) {
  return tree.wordsOf(block).empty() && tree.statementsOf(block).empty();
}

} // namespace feedhold
