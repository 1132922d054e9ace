// The file as a whole: leader, tape marks, blocks; and the parser's handling of tokens and issues.
#include "language/parse/parse.h"

#include "base/support/text.h"
#include "language/dialect/remarks.h"
#include "language/parse/parser.h"

#include <algorithm>

namespace feedhold {

namespace {

constexpr std::string_view kFolderLine = "&F="; // of a dump

/// Offset of the first `%` that is the first sign on its line; npos when there is none.
std::size_t firstTapeMark(std::string_view text, std::size_t from) {
  for (std::size_t at = text.find('%', from); at != std::string_view::npos; at = text.find('%', at + 1)) {
    std::size_t head = at;
    while (head > 0 && isTrivia(text[head - 1]))
      --head;
    if (head == 0 || text[head - 1] == '\n' || text[head - 1] == '\r' || text[head - 1] == ';')
      return at;
  }
  return std::string_view::npos;
}

/// Whether text before the first `%` reads as program: some line begins with O, N, G or `#` and a digit.
bool readsAsProgram(std::string_view text) {
  bool lineHead = true;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    const char c = toUpper(text[i]);
    if (lineHead && (c == 'O' || c == 'N' || c == 'G' || c == '#' || c == ':') && isDigit(text[i + 1]))
      return true;
    if (!isTrivia(text[i]))
      lineHead = text[i] == '\n' || text[i] == '\r';
  }
  return false;
}

/// Precedence where the dialect lacks the operator, so that the tree is right even where a rule complains.
constexpr std::uint8_t usualPrecedence(OperatorKind op) {
  switch (op) {
  case OperatorKind::Power: return 4;
  case OperatorKind::Multiply:
  case OperatorKind::Divide:
  case OperatorKind::Modulo:
  case OperatorKind::And: return 3;
  case OperatorKind::Add:
  case OperatorKind::Subtract:
  case OperatorKind::Or:
  case OperatorKind::Xor: return 2;
  case OperatorKind::Equal:
  case OperatorKind::NotEqual:
  case OperatorKind::GreaterThan:
  case OperatorKind::GreaterOrEqual:
  case OperatorKind::LessThan:
  case OperatorKind::LessOrEqual: return 1;
  }
  return 1;
}

} // namespace

SyntaxTree parse(const SourceFile &source, const Dialect &dialect) { return Parser(source.text(), dialect).run(); }

Parser::Parser(std::string_view text, const Dialect &dialect)
    : text_(text), dialect_(dialect), grammar_(dialect.grammar), lexer_(text, dialect.grammar) {
  for (std::size_t i = 0; i <= static_cast<std::size_t>(OperatorKind::LessOrEqual); ++i) {
    const auto op = static_cast<OperatorKind>(i);
    const int own = precedenceOf(dialect, op);
    precedence_[i] = own > 0 ? static_cast<std::uint8_t>(own) : usualPrecedence(op);
  }
}

SyntaxTree Parser::run() {
  reserve();
  readLeader();
  token_ = lexer_.next();
  while (!at(TokenKind::EndOfFile))
    if (!readDumpLine() && !readDirective())
      readBlock();
  openBlock(static_cast<std::uint32_t>(text_.size())); // the end mark
  tree_.blocks.add(block_);
  // Leader lines of a comment that goes on over a line end may be reported late.
  std::stable_sort(tree_.issues.begin(), tree_.issues.end(),
                   [](const SyntaxIssue &a, const SyntaxIssue &b) { return a.span.begin < b.span.begin; });
  return std::move(tree_);
}

/// Sizes the stores from a sample, so that those of a long program do not grow by copying.  In plain code its letters
/// are its words and its line ends its blocks; a macro statement has about three nodes for each `#` and two for each
/// bracket. Untouched reserve costs no memory.
void Parser::reserve() {
  constexpr std::size_t kSample = 1 << 16;
  std::size_t letters = 0;
  std::size_t lines = 1;
  std::size_t hashes = 0;
  std::size_t brackets = 0;
  for (const char c : text_.substr(0, kSample)) {
    letters += isLetter(c);
    lines += c == '\n';
    hashes += c == '#';
    brackets += c == '[';
  }
  const std::size_t scale = text_.size() / kSample + 1;
  tree_.words.reserve(letters * scale);
  tree_.blocks.reserve((lines + 1) * scale);
  tree_.expressions.reserve((3 * hashes + 2 * brackets) * scale);
  tree_.statements.reserve(hashes / 2 * scale);
}

/// Text before the first `%` is not read by the control, unless there is a program in it: then the file merely has
/// no `%` at its head.
void Parser::readLeader() {
  const std::size_t mark = firstTapeMark(text_, 0);
  if (mark == std::string_view::npos || readsAsProgram(text_.substr(0, mark)))
    return;
  std::uint32_t begin = lexer_.next().begin;
  while (begin < mark) {
    readRawLine(begin, Block::kLeader);
    Lexer behind = lexer_;
    begin = behind.next().begin;
  }
  lexer_.moveTo(begin);
}

/// A line that is not program text, as one block without issues; the lexer goes on behind its line end.
void Parser::readRawLine(std::uint32_t begin, int flags) {
  openBlock(begin);
  lexer_.moveTo(lexer_.lineEnd(begin));
  lastEnd_ = lexer_.lineEnd(begin);
  block_.flags |= static_cast<std::uint16_t>(flags);
  if (lastEnd_ > begin)
    addStatement(begin, BrokenStatement{});
  block_.end = lastEnd_;
  tree_.blocks.add(block_);
  Lexer behind = lexer_;
  const Token end = behind.next();
  if (end.kind != TokenKind::EndOfBlock)
    return;
  lexer_.moveTo(end.end);
  lastEnd_ = end.end;
}

/// Lines that FANUC writes into the dump of a whole memory: `&F=/USER/PATH1/` before the programs of a folder, and the
/// encrypted text of protected programs, `G10L60P1[*..*]` and `[*..*]`.
bool Parser::readDumpLine() {
  const std::string_view line = text_.substr(token_.begin, lexer_.lineEnd(token_.begin) - token_.begin);
  const bool isFolder = line.starts_with(kFolderLine);
  const bool begins = (line.starts_with("G10L60") || line.starts_with("G10 L60")) && line.find("[*") != line.npos;
  const bool isEncrypted = line.starts_with("[*") || begins || isEncryptedTextOpen_;
  if (!isFolder && (!isEncrypted || tape_ == Tape::Closed))
    return false;
  isEncryptedTextOpen_ = !isFolder && !trimmed(line).ends_with("*]") && isEncryptedTextClosed(token_.begin);
  if (tape_ == Tape::Closed)
    tape_ = Tape::Open;
  readRawLine(token_.begin, isFolder ? Block::kLeader | Block::kFolder : Block::kBroken | Block::kEncrypted);
  contentSinceMark_ = true;
  token_ = lexer_.next();
  return true;
}

/// The encrypted text that begins here may go on over further lines; it ends before the next program does.
bool Parser::isEncryptedTextClosed(std::uint32_t from) const {
  const std::size_t close = text_.find("*]", from);
  if (close == text_.npos)
    return false;
  const std::string_view between = text_.substr(from, close - from);
  for (std::size_t at = between.find('\n'); at != between.npos; at = between.find('\n', at + 1)) {
    const std::string_view line = between.substr(at + 1);
    const bool isHead = line.size() > 1 && toUpper(line[0]) == 'O' && isDigit(line[1]);
    if (isHead || line.starts_with('%') || line.starts_with(kFolderLine) || line.starts_with("M99") ||
        line.starts_with("G10"))
      return false;
  }
  return true;
}

bool Parser::readDirective() {
  if (!at(TokenKind::OpenBracket) ||
      !isSimulatorDirective(text_.substr(token_.begin, lexer_.lineEnd(token_.begin) - token_.begin)))
    return false;
  readRawLine(token_.begin, Block::kLeader);
  token_ = lexer_.next();
  return true;
}

/// `M99O0810(NEXT)`, `M30&F=/USER/`: dumps run programs together where a line end is missing.
bool Parser::beginsNextProgram() const {
  const bool isFolder = token_.begin < text_.size() && text_.substr(token_.begin).starts_with(kFolderLine);
  const bool isHead = at(TokenKind::Address) && token_.letter() == 'O';
  if ((!isFolder && !isHead) || grammar_.oWords || tree_.words.size() <= block_.firstWord.index())
    return false;
  const Word &last = tree_.words[WordId(tree_.words.size() - 1)];
  const std::optional<std::uint32_t> code = last.address() == 'M' ? last.integer() : std::nullopt;
  return (code == 99 || code == 30 || code == 2) && (isFolder || peek().kind == TokenKind::Number);
}

/// `%` at the head of a block opens the tape, or closes it when program text has been read since it was opened; the
/// first `%` of a file, when more than a title stands in front of it.  The rest of its line is a leader that the
/// control skips, unless it is the head of a program (`%O5000(TITLE)`).
void Parser::readTapeMark() {
  const bool closes = contentSinceMark_ && tape_ != Tape::Closed;
  tape_ = closes ? Tape::Closed : Tape::Open;
  contentSinceMark_ = false;
  block_.flags |= Block::kPercent;
  const Token mark = token_;
  advance();
  const bool head =
      at(TokenKind::Colon) || (at(TokenKind::Address) && token_.letter() == 'O' && peek().kind == TokenKind::Number);
  if (head && !closes)
    return;
  const std::uint32_t end = lexer_.lineEnd(mark.begin);
  moveTo(end);
  lastEnd_ = end;
  addStatement(mark.begin, BrokenStatement{});
}

void Parser::advance() {
  if (token_.abbreviated && !broken_ && !quiet_)
    tree_.abbreviations.push_back(token_.span());
  lastEnd_ = token_.end;
  token_ = lexer_.next();
  if (commentsAreBlanks_)
    takeCommentsAsBlanks();
}

/// Behind an address: `X(WIDTH)10.`
void Parser::advanceToValue() {
  const bool before = std::exchange(commentsAreBlanks_, true);
  advance();
  commentsAreBlanks_ = before;
}

/// A comment with a fault ends what is being read: readComment() says what is wrong with it.
void Parser::takeCommentsAsBlanks() {
  while (at(TokenKind::Comment) && text_[token_.begin] == '(') {
    const std::string_view inner = text_.substr(token_.begin + 1, token_.span().size() - 1);
    if (inner.find_first_of("(\r\n") != std::string_view::npos || !inner.ends_with(')'))
      return;
    tree_.comments.add({token_.span(), true});
    token_ = lexer_.next();
  }
}

Token Parser::peek() const {
  Lexer ahead = lexer_;
  return ahead.next();
}

void Parser::moveTo(std::uint32_t offset) {
  lexer_.moveTo(offset);
  token_ = lexer_.next();
  lastEnd_ = offset;
}

void Parser::issue(SyntaxIssueKind kind, Span span, Span other, Broken broken) {
  if (!broken_ && !quiet_)
    tree_.issues.push_back({kind, span, other});
  if (broken == Broken::Yes) {
    broken_ = true;
    block_.flags |= Block::kBroken;
  }
}

/// The value of token_, a Number.
std::optional<Decimal> Parser::numberHere() {
  const NumberText &number = lexer_.lastNumber();
  if (number.points > 1) {
    issue(SyntaxIssueKind::TwoDecimalPoints, token_.span(), {}, Broken::No);
    return std::nullopt;
  }
  if (number.digits > NumberText::kMostDigits || number.decimals > NumberText::kMostDigits) {
    issue(SyntaxIssueKind::NumberTooLong, token_.span(), {}, Broken::No);
    return std::nullopt;
  }
  return Decimal(number.mantissa, static_cast<std::uint8_t>(number.decimals));
}

} // namespace feedhold
