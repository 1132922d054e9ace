// Blocks and words.
#include "base/support/text.h"
#include "language/parse/parser.h"

#include <algorithm>
#include <optional>

namespace feedhold {

namespace {

/// Spreads a span over another piece of text.
void extend(std::optional<Span> &span, Span piece) { span = span ? cover(*span, piece) : piece; }

} // namespace

void Parser::readBlock() {
  openBlock(lastEnd_);
  if (at(TokenKind::Percent))
    readTapeMark();
  while (!atEnd() && !beginsNextProgram())
    readItem();
  closeBlock();
  if (at(TokenKind::EndOfBlock))
    advance();
}

void Parser::openBlock(std::uint32_t begin) {
  block_ = Block{begin, begin, WordId(tree_.words.size()), StatementId(tree_.statements.size()),
                 CommentId(tree_.comments.size())};
  broken_ = false;
  quiet_ = false;
  wordFlags_ = 0;
  headOfBlock_ = true;
  operatorsInBlock_ = 0;
  itemsInBlock_ = 0;
  statementInBlock_.reset();
  lowerCase_.reset();
  if (tape_ == Tape::Closed && !at(TokenKind::Percent)) {
    // A program head behind the closing `%` begins a further program: files are joined this way.
    const bool head = at(TokenKind::Colon) || (at(TokenKind::Address) && token_.letter() == 'O');
    if (head)
      tape_ = Tape::Open;
    else
      block_.flags |= Block::kAfterEnd;
    quiet_ = !head;
  }
}

void Parser::closeBlock() {
  block_.end = token_.begin;
  if (lowerCase_ && !quiet_)
    tree_.lowerCase.push_back(*lowerCase_);
  noteBlockCodes();
  markArguments();
  tree_.blocks.add(block_);
}

void Parser::readItem() {
  contentSinceMark_ = contentSinceMark_ || tape_ != Tape::Unmarked || !atTitle();
  if (++itemsInBlock_ > kMostItems)
    issue(SyntaxIssueKind::BlockTooLong, token_.span(), {}, Broken::Yes);
  if (broken_ && !at(TokenKind::Comment)) {
    skipBrokenRest();
    return;
  }
  switch (token_.kind) {
  case TokenKind::Address:
    if (atOWord())
      readStatement();
    else
      readWord();
    return;
  case TokenKind::Comment: readComment(); return;
  case TokenKind::Slash: readBlockSkip(); return;
  case TokenKind::Comma: readCommaWord(); return;
  case TokenKind::Colon: readWord(); return;
  case TokenKind::CloseParenthesis: readStrayCloseParenthesis(); return;
  case TokenKind::Name:
    tree_.words.add(Word('<', WordForm::Name, token_.span(), wordFlags_));
    advance();
    return;
  case TokenKind::Hash:
  case TokenKind::OpenBracket: readStatement(); return;
  case TokenKind::CloseBracket: takeStrayCloseBrackets(Broken::Yes); return;
  case TokenKind::ControlWord:
    if (!grammar_.oWords) {
      readStatement();
      return;
    }
    [[fallthrough]];
  case TokenKind::OWord:
  case TokenKind::Number:
  case TokenKind::Function:
  case TokenKind::Operator:
  case TokenKind::Plus:
  case TokenKind::Minus:
  case TokenKind::Star:
  case TokenKind::Equals:
  case TokenKind::Percent:
  case TokenKind::Less:
  case TokenKind::Greater:
  case TokenKind::Other:
    issue(SyntaxIssueKind::UnexpectedText, token_.span(), {}, Broken::Yes);
    skipBrokenRest();
    return;
  case TokenKind::EndOfFile:
  case TokenKind::EndOfBlock: return;
  }
}

/// The number or the name of a program, or a comment: what people write above the opening `%`, too.
bool Parser::atTitle() const {
  const bool isNumber = at(TokenKind::Address) && token_.letter() == 'O' && !grammar_.oWords;
  return isNumber || at(TokenKind::Colon) || at(TokenKind::Name) || at(TokenKind::Comment);
}

/// `X12.5`, `:1000` (an O word), `M`, `O<name>`.
void Parser::readWord() {
  const Token head = token_;
  const char address = head.kind == TokenKind::Colon ? 'O' : head.letter();
  if (text_[head.begin] >= 'a')
    extend(lowerCase_, head.span());
  headOfBlock_ = headOfBlock_ && address == 'N';
  advanceToValue();
  if (grammar_.oWords && address == 'O' && at(TokenKind::Name)) {
    const Span span{head.begin, token_.end};
    advance();
    tree_.words.add(Word('O', WordForm::Name, span, wordFlags_));
    return;
  }
  readWordValue(address, head.begin, wordFlags_);
}

void Parser::readWordValue(char address, std::uint32_t begin, std::uint8_t wordFlags) {
  const std::uint32_t headEnd = lastEnd_;
  const bool sign = at(TokenKind::Minus) || at(TokenKind::Plus);
  if (sign && peek().kind == TokenKind::Number) {
    const bool negative = at(TokenKind::Minus);
    advance();
    addNumberWord(address, begin, wordFlags | Word::kSigned, negative);
    return;
  }
  if (at(TokenKind::Number)) {
    addNumberWord(address, begin, wordFlags, false);
    return;
  }
  if (startsOperand(token_)) {
    const ExpressionId value = operand();
    readUnbracketedRest(address, begin, sign ? wordFlags | Word::kSigned : wordFlags, value);
    return;
  }
  const bool parentheses = address != 'N' && address != 'O' && expressionInParentheses();
  if (!parentheses)
    issue(SyntaxIssueKind::MissingValue, {begin, headEnd}, {}, Broken::No);
  const bool placeholder = at(TokenKind::Other) && text_[token_.begin] == '?';
  if (placeholder)
    advance();
  tree_.words.add(Word(address, placeholder ? WordForm::Broken : WordForm::Missing, {begin, lastEnd_}, wordFlags));
}

/// token_ is the number of the word.
void Parser::addNumberWord(char address, std::uint32_t begin, std::uint8_t wordFlags, bool negative) {
  const Token digits = token_;
  const std::optional<Decimal> value = numberHere();
  if (lexer_.lastNumber().points > 0)
    wordFlags |= Word::kPoint;
  advance();
  if (wordGoesOn()) {
    const ExpressionId literal =
        tree_.expressions.add(Expression{digits.span(), NumberLiteral{value.value_or(Decimal())}});
    const ExpressionId left = negative ? addExpression(begin + 1, Negation{literal}) : literal;
    readUnbracketedRest(address, begin, wordFlags, left);
    return;
  }
  const Span span{begin, digits.end};
  if (value)
    tree_.words.add(Word::number(address, negative ? value->negated() : *value, span, wordFlags));
  else
    tree_.words.add(Word(address, WordForm::Broken, span, wordFlags));
}

/// An operator and an operand behind the value of a word: `X#1+2`.  In `T01 MO6` the letter O stands for the digit: it
/// is MOD for the control, which stops either way, and M06 for whoever wrote it.
bool Parser::wordGoesOn() const {
  if (!peekOperator() || !slashCanDivide() || !startsOperand(peek()))
    return false;
  const bool isModulo = at(TokenKind::Operator) && token_.op() == OperatorKind::Modulo && token_.abbreviated;
  return !isModulo || peek().kind != TokenKind::Number || peek().begin != token_.end;
}

/// The rest of `X#1+2`: an expression after an address that no bracket holds together.
void Parser::readUnbracketedRest(char address, std::uint32_t begin, std::uint8_t wordFlags, ExpressionId left) {
  ExpressionId value = left;
  if (wordGoesOn()) {
    const std::uint32_t from = token_.begin;
    value = binaryRest(left, 1);
    issue(SyntaxIssueKind::UnbracketedExpression, since(from), {begin, lastEnd_}, Broken::No);
  }
  if (address == 'O' || address == 'N')
    issue(SyntaxIssueKind::ComputedNumberForbidden, spanOf(value), {begin, lastEnd_}, Broken::No);
  tree_.words.add(Word::expression(address, value, {begin, lastEnd_}, wordFlags));
}

/// `,R5.` `,C2.` `,A30.`
void Parser::readCommaWord() {
  const std::uint32_t begin = token_.begin;
  if (peek().kind != TokenKind::Address) {
    issue(SyntaxIssueKind::UnexpectedText, token_.span(), {}, Broken::Yes);
    skipBrokenRest();
    return;
  }
  advance();
  const char address = token_.letter();
  headOfBlock_ = false;
  advance();
  readWordValue(address, begin, wordFlags_ | Word::kComma);
}

/// `/` or `/3` at the head of the block; elsewhere it makes the rest of the block optional.
void Parser::readBlockSkip() {
  const Token slash = token_;
  advance();
  std::uint8_t level = 1;
  bool levelIsFine = true;
  const bool levelIsWritten = at(TokenKind::Number); // `/1/3` is two levels; `//3` is not
  if (levelIsWritten) {
    const std::optional<std::int64_t> number = numberHere().value_or(Decimal(0, 0)).asInteger();
    levelIsFine = number && *number >= 1 && *number <= 9;
    level = levelIsFine ? static_cast<std::uint8_t>(*number) : 1;
    advance();
  }
  const bool isDouble = !levelIsWritten && at(TokenKind::Slash); // a remark of other languages, or a slip
  if (!levelIsFine || isDouble)
    issue(SyntaxIssueKind::BlockSkipLevel, {slash.begin, at(TokenKind::Slash) ? token_.end : lastEnd_}, {},
          isDouble ? Broken::Yes : Broken::No);
  if (headOfBlock_) {
    block_.flags |= Block::kSkip;
    block_.skipLevel = level;
  } else {
    issue(SyntaxIssueKind::MisplacedBlockSkip, since(slash.begin), {}, Broken::No);
    block_.flags |= Block::kSkipInside;
    wordFlags_ |= Word::kAfterSkip;
  }
  tree_.skips.push_back(since(slash.begin));
}

void Parser::readComment() {
  const Span span = token_.span();
  if (text_[span.begin] == ';') {
    tree_.comments.add({span, true});
    advance();
    return;
  }
  const std::string_view inner = text_.substr(span.begin + 1, span.size() - 1);
  // A comment that was read over a line end is one that its line does not close.
  const bool closed = inner.ends_with(')') && inner.find_first_of("\r\n") == std::string_view::npos;
  tree_.comments.add({span, closed});
  advance();
  const std::size_t open = inner.find('(');
  // `(A (B) C)`: the comment ends at the first `)`, and ` C)` would be read as program text.
  if (open != std::string_view::npos && closed && !atEnd()) {
    if (const std::optional<std::uint32_t> end = endOfNesting(span)) {
      const auto inside = static_cast<std::uint32_t>(span.begin + 1 + open);
      issue(SyntaxIssueKind::NestedComment, {inside, inside + 1}, {span.begin, *end}, Broken::No);
      const std::uint32_t begin = token_.begin;
      moveTo(*end);
      addStatement(begin, BrokenStatement{});
      block_.flags |= Block::kCommentTail;
      return;
    }
  }
  if (!closed)
    issue(SyntaxIssueKind::UnclosedComment, span, {}, Broken::No);
}

/// Where the comment was meant to end: behind the `)` that belongs to its first `(`, or, where none does, behind one
/// that follows without another `(` before it.
std::optional<std::uint32_t> Parser::endOfNesting(Span comment) const {
  const std::string_view rest = text_.substr(comment.end, kRecoveryWindow);
  const std::string_view line = rest.substr(0, rest.find_first_of("\r\n"));
  const auto endAt = [&](std::size_t i) { return comment.end + static_cast<std::uint32_t>(i) + 1; };
  const std::string_view inside = text_.substr(comment.begin, comment.size());
  auto depth = std::ranges::count(inside, '(') - 1; // the comment holds one `)`
  for (std::size_t i = 0; i < line.size(); ++i) {
    depth += line[i] == '(' ? 1 : line[i] == ')' ? -1 : 0;
    if (depth == 0)
      return endAt(i);
  }
  const std::size_t next = line.find_first_of("()");
  if (next == std::string_view::npos || line[next] != ')')
    return std::nullopt;
  return endAt(next);
}

void Parser::readStrayCloseParenthesis() {
  const std::uint32_t begin = token_.begin;
  issue(SyntaxIssueKind::StrayCloseParenthesis, token_.span(), {}, Broken::No);
  block_.flags |= Block::kCommentTail;
  while (at(TokenKind::CloseParenthesis))
    advance();
  addStatement(begin, BrokenStatement{});
}

/// Everything up to the end of the block or a comment, as one hole.
void Parser::skipBrokenRest() {
  const std::uint32_t begin = token_.begin;
  while (!atEnd() && !at(TokenKind::Comment))
    advance();
  if (lastEnd_ > begin)
    addStatement(begin, BrokenStatement{});
}

/// Data lines of `G10 L50` and `G10 L52` up to `G11`: there N is the number of a machine parameter.
void Parser::noteBlockCodes() {
  if (dataBlocks_)
    block_.flags |= Block::kData;
  bool dataSetting = false;
  bool parameters = false;
  for (std::size_t i = block_.firstWord.index(); i < tree_.words.size(); ++i) {
    const Word &word = tree_.words[WordId(i)];
    if (word.address() == 'O' || (word.address() == 'G' && word.tenths() == 110)) {
      dataBlocks_ = false;
      block_.flags &= static_cast<std::uint16_t>(~Block::kData);
    }
    dataSetting = dataSetting || (word.address() == 'G' && word.tenths() == 100);
    parameters = parameters || (word.address() == 'L' && (word.integer() == 50u || word.integer() == 52u));
  }
  dataBlocks_ = dataBlocks_ || (dataSetting && parameters);
}

/// Behind `G65` and its like every word is an argument whose address can be one, whatever it means elsewhere.
void Parser::markArguments() {
  if (block_.has(Block::kData))
    return;
  bool inCall = false;
  for (std::size_t i = block_.firstWord.index(); i < tree_.words.size(); ++i) {
    Word &word = tree_.words[WordId(i)];
    if (inCall && !word.has(Word::kComma) && argumentVariable(dialect_, word.address()) != 0)
      word.mark(Word::kArgument);
    else
      inCall = inCall || (word.tenths() && callsMacro(dialect_, word.address(), *word.tenths()));
  }
}

} // namespace feedhold
