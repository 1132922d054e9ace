// One switch over the class of the first byte; the common case, a letter before a digit, is decided first.
#include "language/lex/lexer.h"

#include "base/support/check.h"
#include "base/support/text.h"
#include "language/lex/keywords.h"

#include <algorithm>
#include <array>

namespace feedhold {

namespace {

enum class ByteClass : std::uint8_t { Other, Trivia, Letter, Digit, LineEnd, Symbol, Parenthesis, Angle };

constexpr std::array<ByteClass, 256> buildClasses() {
  std::array<ByteClass, 256> classes{};
  for (int c = 0; c < 0x21; ++c)
    classes[c] = ByteClass::Trivia;
  classes[0x7f] = ByteClass::Trivia;
  for (int c = 'A'; c <= 'Z'; ++c)
    classes[c] = classes[c - 'A' + 'a'] = ByteClass::Letter;
  for (int c = '0'; c <= '9'; ++c)
    classes[c] = ByteClass::Digit;
  classes['.'] = ByteClass::Digit;
  classes['\n'] = classes['\r'] = classes[';'] = ByteClass::LineEnd;
  for (const char c : {'#', '[', ']', '+', '-', '*', '/', '=', ',', ':', '%', ')', '>'})
    classes[static_cast<unsigned char>(c)] = ByteClass::Symbol;
  classes['('] = ByteClass::Parenthesis;
  classes['<'] = ByteClass::Angle;
  return classes;
}
constexpr std::array<ByteClass, 256> kClasses = buildClasses();

ByteClass classOf(char c) { return kClasses[static_cast<unsigned char>(c)]; }

constexpr std::array<TokenKind, 256> buildSymbols() {
  std::array<TokenKind, 256> kinds{};
  kinds['#'] = TokenKind::Hash;
  kinds['['] = TokenKind::OpenBracket;
  kinds[']'] = TokenKind::CloseBracket;
  kinds['+'] = TokenKind::Plus;
  kinds['-'] = TokenKind::Minus;
  kinds['*'] = TokenKind::Star;
  kinds['/'] = TokenKind::Slash;
  kinds['='] = TokenKind::Equals;
  kinds[','] = TokenKind::Comma;
  kinds[':'] = TokenKind::Colon;
  kinds['%'] = TokenKind::Percent;
  kinds[')'] = TokenKind::CloseParenthesis;
  kinds['>'] = TokenKind::Greater;
  return kinds;
}
constexpr std::array<TokenKind, 256> kSymbols = buildSymbols();

/// What directly follows the letter of a word with a value.
bool startsValue(char c) { return classOf(c) == ByteClass::Digit || c == '#' || c == '[' || c == '-' || c == '+'; }

/// No keyword is longer; a longer run need not be read to its end to find one.
constexpr std::uint32_t kLongestKeywordRun = 24;
constexpr std::size_t kLongestOWord = 9; // ENDREPEAT

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

} // namespace

std::string_view nameOf(TokenKind kind) {
  static constexpr std::string_view kNames[] = {
#define TOKEN(kind, name) name,
#include "language/lex/tokens.def"
  };
  return kNames[static_cast<std::size_t>(kind)];
}

bool isTrivia(char c) { return classOf(c) == ByteClass::Trivia; }

Lexer::Lexer(std::string_view text, const Grammar &grammar) : text_(text), grammar_(&grammar) {
  if (text_.starts_with(kByteOrderMark))
    at_ = static_cast<std::uint32_t>(kByteOrderMark.size());
}

Token Lexer::next() {
  const std::uint32_t begin = at_ = afterBlanks(at_);
  if (begin == size())
    return make(TokenKind::EndOfFile, begin, begin);
  switch (classOf(text_[begin])) {
  case ByteClass::Letter: return letters(begin);
  case ByteClass::Digit: return number(begin);
  case ByteClass::LineEnd: return endOfBlock(begin);
  case ByteClass::Symbol:
    if (text_[begin] == '*' && grammar_->doubleStar)
      return star(begin);
    return make(kSymbols[static_cast<unsigned char>(text_[begin])], begin, begin + 1);
  case ByteClass::Parenthesis: return comment(begin);
  case ByteClass::Angle: return angle(begin);
  case ByteClass::Trivia:
  case ByteClass::Other: return other(begin);
  }
  FEEDHOLD_UNREACHABLE("the switch names every class");
}

std::uint32_t Lexer::lineEnd(std::uint32_t offset) const {
  while (offset < size() && text_[offset] != '\n' && text_[offset] != '\r')
    ++offset;
  return offset;
}

std::optional<std::uint32_t> Lexer::closingBracket(std::uint32_t open) const {
  int depth = 0;
  for (std::uint32_t i = open; i < size() && text_[i] != '\n' && text_[i] != '\r'; ++i) {
    depth += text_[i] == '[' ? 1 : text_[i] == ']' ? -1 : 0;
    if (depth == 0)
      return i;
  }
  return std::nullopt;
}

/// An address, a keyword, or a word of prose.  `X` before a value is an address; in a longer run the keyword at its
/// start is taken (`GOTO10`, `ANDABS[`), or the address before a function (`XSIN[30.]`); other runs of three letters
/// and more are no program text.
Token Lexer::letters(std::uint32_t begin) {
  const auto address = [&] {
    Token token = make(TokenKind::Address, begin, begin + 1);
    token.detail = static_cast<std::uint8_t>(toUpper(text_[begin]));
    return token;
  };
  const char second = at(begin + 1);
  if (startsValue(second))
    return address();
  if (grammar_->oWords)
    if (const Token word = oWord(begin); word.kind == TokenKind::OWord)
      return word;
  if (!isLetter(second))
    return address();
  const std::uint32_t end = afterLetters(begin, begin + kLongestKeywordRun);
  const std::uint32_t behind = afterBlanks(end);
  const std::string_view run = text_.substr(begin, end - begin);
  KeywordMatch match = matchKeyword(run, at(behind));
  if (match.abbreviated && !grammar_->shortForms)
    match = {};
  // `GO TO 10`: the only keyword that people write in two.
  if (run.size() == 2 && toUpper(run) == "GO" && toUpper(text_.substr(behind, 2)) == "TO" && !isLetter(at(behind + 2)))
    match = {TokenKind::ControlWord, static_cast<std::uint8_t>(ControlWord::Goto),
             static_cast<std::uint8_t>(behind + 2 - begin), false};
  if (match.kind != TokenKind::Other) {
    Token token = make(match.kind, begin, begin + match.length);
    token.detail = match.detail;
    token.abbreviated = match.abbreviated;
    return token;
  }
  const KeywordMatch inside = matchKeyword(run.substr(1), at(behind));
  const bool valueIsFunction = inside.kind == TokenKind::Function && inside.length + 1u == run.size();
  return run.size() < 3 || valueIsFunction ? address() : make(TokenKind::Other, begin, afterLetters(end, size()));
}

/// `endsub`, `end sub`, `W H I L E`: the control takes out blanks before it reads.  All letters up to the next other
/// sign are the o-word, or it is none.
Token Lexer::oWord(std::uint32_t begin) {
  std::string letters;
  std::uint32_t end = begin;
  for (std::uint32_t i = begin; isLetter(at(i)) && letters.size() <= kLongestOWord; i = afterBlanks(i + 1)) {
    letters += text_[i];
    end = i + 1;
  }
  const std::optional<OWordKind> kind = findOWord(letters);
  if (!kind)
    return {begin, end, TokenKind::Other, 0, false};
  Token token = make(TokenKind::OWord, begin, end);
  token.detail = static_cast<std::uint8_t>(*kind);
  return token;
}

/// Digits and points; blanks inside belong to the number, because two numbers never stand side by side.
Token Lexer::number(std::uint32_t begin) {
  NumberText number;
  const char *const last = text_.data() + text_.size();
  const char *end = text_.data() + begin;
  for (const char *at = end; at != last; ++at) {
    const char c = *at;
    if (isDigit(c)) {
      number.digits += number.mantissa != 0 || c != '0';
      if (number.digits <= NumberText::kMostDigits)
        number.mantissa = number.mantissa * 10 + (c - '0');
      number.decimals += number.points;
      end = at + 1;
    } else if (c == '.') {
      ++number.points;
      end = at + 1;
    } else if (classOf(c) != ByteClass::Trivia) {
      break;
    }
  }
  number_ = number;
  return make(TokenKind::Number, begin, static_cast<std::uint32_t>(end - text_.data()));
}

/// Up to the first `)`: comments do not nest.  One that is not closed on its line ends there, unless the next line is
/// plainly the rest of it: prose up to a `)`, without a digit or a sign of program text.
Token Lexer::comment(std::uint32_t begin) {
  std::uint32_t end = begin;
  while (end < size() && text_[end] != ')' && text_[end] != '\n' && text_[end] != '\r')
    ++end;
  if (at(end) == ')')
    return make(TokenKind::Comment, begin, end + 1);
  for (std::uint32_t i = afterLineEnd(end); i < size(); ++i) {
    const char c = text_[i];
    if (c == ')')
      return make(TokenKind::Comment, begin, i + 1);
    if (c == '\n' || c == '\r' || c == '(' || c == '#' || c == '%' || c == ';' || c == '[' || isDigit(c))
      break;
  }
  return make(TokenKind::Comment, begin, endOfParagraph(end).value_or(end));
}

/// A line of `)` alone closes what a line before it opens, unless another comment, a program or a tape mark comes
/// between them.
std::optional<std::uint32_t> Lexer::endOfParagraph(std::uint32_t from) const {
  constexpr std::uint32_t kLongest = 2000;
  const std::uint32_t limit = std::min(size(), from + kLongest);
  for (std::uint32_t line = afterLineEnd(from); line < limit;) {
    std::uint32_t i = line;
    while (i < limit && (text_[i] == ' ' || text_[i] == '\t'))
      ++i;
    if (at(i) == '%' || ((at(i) == 'O' || at(i) == 'o') && isDigit(at(i + 1))))
      return std::nullopt;
    const bool closes = at(i) == ')';
    const std::uint32_t close = i + 1;
    for (i = closes ? close : i; i < limit && text_[i] != '\n' && text_[i] != '\r'; ++i)
      if (text_[i] == '(' || (closes && text_[i] != ' ' && text_[i] != '\t'))
        return std::nullopt;
    if (closes)
      return close;
    line = std::max(afterLineEnd(i), i + 1);
  }
  return std::nullopt;
}

/// `**`, which blanks may part; `*` alone.
Token Lexer::star(std::uint32_t begin) {
  const std::uint32_t second = afterBlanks(begin + 1);
  if (at(second) != '*')
    return make(TokenKind::Star, begin, begin + 1);
  Token token = make(TokenKind::Operator, begin, second + 1);
  token.detail = static_cast<std::uint8_t>(OperatorKind::Power);
  return token;
}

/// A line end, or `;` with the line end behind it; a comment where `;` begins one.
Token Lexer::endOfBlock(std::uint32_t begin) {
  if (text_[begin] != ';')
    return make(TokenKind::EndOfBlock, begin, afterLineEnd(begin));
  if (grammar_->semicolonComment)
    return make(TokenKind::Comment, begin, lineEnd(begin));
  const std::uint32_t behind = afterBlanks(begin + 1);
  const bool lineEnds = at(behind) == '\n' || at(behind) == '\r';
  return make(TokenKind::EndOfBlock, begin, lineEnds ? afterLineEnd(behind) : begin + 1);
}

/// Whether nothing but a program number stands in front of it on its line.
bool Lexer::followsProgramNumber(std::uint32_t offset) const {
  const auto isBlankAt = [this](std::uint32_t i) { return text_[i] == ' ' || text_[i] == '\t'; };
  std::uint32_t i = offset;
  while (i > 0 && isBlankAt(i - 1))
    --i;
  const std::uint32_t digitsEnd = i;
  while (i > 0 && isDigit(text_[i - 1]))
    --i;
  if (i == digitsEnd || i == 0 || toUpper(text_[--i]) != 'O')
    return false;
  while (i > 0 && isBlankAt(i - 1))
    --i;
  return i == 0 || text_[i - 1] == '\n' || text_[i - 1] == '\r';
}

/// `<NAME>`, or the sign alone.  Names of parameters may hold any sign, blanks too, and so may the title behind a
/// program number: `O9123<FACE AND BORE>`.
Token Lexer::angle(std::uint32_t begin) {
  std::uint32_t end = begin + 1;
  const bool holdsAnySign = grammar_->namedParameters || followsProgramNumber(begin);
  const auto inName = [holdsAnySign](char c) {
    return holdsAnySign ? c != '>' && c != '\n' && c != '\r' && c != '('
                        : isLetter(c) || isDigit(c) || c == '+' || c == '-' || c == '_' || c == '.';
  };
  while (end < size() && inName(text_[end]))
    ++end;
  if (at(end) == '>' && end > begin + 1)
    return make(TokenKind::Name, begin, end + 1);
  return make(TokenKind::Less, begin, begin + 1);
}

Token Lexer::other(std::uint32_t begin) {
  std::uint32_t end = begin + 1;
  if (grammar_->signAddresses.find(text_[begin]) != std::string_view::npos) {
    Token token = make(TokenKind::Address, begin, end);
    token.detail = static_cast<std::uint8_t>(text_[begin]);
    return token;
  }
  while (end < size() && classOf(text_[end]) == ByteClass::Other)
    ++end;
  return make(TokenKind::Other, begin, end);
}

Token Lexer::make(TokenKind kind, std::uint32_t begin, std::uint32_t end) {
  at_ = end;
  return {begin, end, kind, 0, false};
}

std::uint32_t Lexer::afterBlanks(std::uint32_t offset) const {
  while (offset < size() && classOf(text_[offset]) == ByteClass::Trivia)
    ++offset;
  return offset;
}

std::uint32_t Lexer::afterLetters(std::uint32_t offset, std::uint32_t limit) const {
  while (offset < std::min(limit, size()) && classOf(text_[offset]) == ByteClass::Letter)
    ++offset;
  return offset;
}

/// LF, CR LF and CR CR LF are one end each, and so is a CR with none of them behind it.
std::uint32_t Lexer::afterLineEnd(std::uint32_t offset) const {
  if (at(offset) != '\r')
    return at(offset) == '\n' ? offset + 1 : offset;
  if (at(offset + 1) == '\r' && at(offset + 2) == '\n')
    return offset + 3;
  return at(offset + 1) == '\n' ? offset + 2 : offset + 1;
}

TokenBuffer lex(const SourceFile &file, const Dialect &dialect) {
  TokenBuffer tokens;
  Lexer lexer(file.text(), dialect.grammar);
  do
    tokens.push_back(lexer.next());
  while (tokens.back().kind != TokenKind::EndOfFile);
  return tokens;
}

} // namespace feedhold
