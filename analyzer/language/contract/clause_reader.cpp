#include "language/contract/clause_reader.h"

#include "base/support/text.h"
#include "language/lex/lexer.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold {

namespace {

bool isNameSign(char c) { return isLetter(c) || isDigit(c) || c == '_' || c == '-' || c == '/'; }

std::size_t afterBlanks(std::string_view text, std::size_t at) {
  while (at < text.size() && isBlank(text[at]))
    ++at;
  return at;
}

/// What stands in the brackets of `NAME[..]`, and where the text goes on.
struct Bracket {
  std::string_view inner;
  std::uint32_t end;
};
std::optional<Bracket> bracketOf(std::string_view rest, std::string_view name) {
  if (toUpper(rest.substr(0, name.size())) != name)
    return std::nullopt;
  const std::size_t open = afterBlanks(rest, name.size());
  constexpr std::size_t kLongest = 32;
  const std::size_t close = rest.substr(0, open + kLongest).find(']', open);
  if (open >= rest.size() || rest[open] != '[' || close == std::string_view::npos)
    return std::nullopt;
  return Bracket{trimmed(rest.substr(open + 1, close - open - 1)), static_cast<std::uint32_t>(close + 1)};
}

std::optional<char> axisIn(std::string_view text) {
  constexpr std::string_view kAxes = "ABCUVWXYZ";
  const bool isAxis = text.size() == 1 && kAxes.find(toUpper(text.front())) != std::string_view::npos;
  return isAxis ? std::optional(toUpper(text.front())) : std::nullopt;
}

/// `510`; absent for what is no number or too long for a variable.
std::optional<std::uint32_t> digitsIn(std::string_view text) {
  constexpr std::size_t kMostDigits = 8;
  if (text.empty() || text.size() > kMostDigits || !std::ranges::all_of(text, isDigit))
    return std::nullopt;
  std::uint32_t number = 0;
  for (const char digit : text)
    number = number * 10 + static_cast<std::uint32_t>(digit - '0');
  return number;
}

ReservedOperand reserved(std::uint32_t length, std::uint32_t number) {
  return {length, Decimal::fromInteger(-static_cast<std::int64_t>(number))};
}

} // namespace

std::optional<ReservedOperand> findPromiseOperand(std::string_view rest) {
  if (const auto bracket = bracketOf(rest, "POS"))
    if (const auto axis = axisIn(bracket->inner))
      return reserved(bracket->end, positionVariable(*axis));
  if (const auto bracket = bracketOf(rest, "ENTRY"))
    if (const auto axis = axisIn(bracket->inner))
      return reserved(bracket->end, entryVariable(*axis));
  if (const auto bracket = bracketOf(rest, "OLD"); bracket && bracket->inner.starts_with('#'))
    if (const auto number = digitsIn(bracket->inner.substr(1)))
      return reserved(bracket->end, oldVariable(*number));
  return std::nullopt;
}

std::optional<ReservedOperand> findPoint(std::string_view rest) {
  const char letter = rest.empty() ? '\0' : toUpper(rest.front());
  if ((letter != 'X' && letter != 'Y' && letter != 'Z') || (rest.size() > 1 && isLetter(rest[1])))
    return std::nullopt;
  return reserved(1, pointVariable(letter));
}

std::optional<ReservedOperand> findPointOfLathe(std::string_view rest) {
  return rest.empty() || toUpper(rest.front()) == 'Y' ? std::nullopt : findPoint(rest);
}

ClauseReader::ClauseReader(ContractReading &reading, ClauseId clause, Span body)
    : reading_(reading), clause_(clause), sourceId_(reading.result.clauses[clause].source),
      source_(reading.result.source(sourceId_)), at_(body.begin), end_(body.end) {
  skipBlanks();
}

void ClauseReader::fail(ContractIssueKind kind, Span span, std::string detail) {
  if (!issue_)
    issue_ =
        ContractIssue{kind, sourceId_, span, std::move(detail), std::nullopt, reading_.result.clauses[clause_].program};
  at_ = end_;
}

void ClauseReader::expected(std::string what) { fail(ContractIssueKind::Malformed, ahead(), std::move(what)); }

void ClauseReader::expectEnd() {
  if (!atEnd())
    expected("the end of the clause");
}

Span ClauseReader::ahead() const {
  std::uint32_t end = at_;
  while (end < end_ && !isBlank(sign(end)))
    ++end;
  return {at_, end};
}

void ClauseReader::skipBlanks() {
  while (at_ < end_ && isTrivia(sign(at_)))
    ++at_;
}

std::optional<Span> ClauseReader::peekName() const {
  if (!isLetter(sign(at_)))
    return std::nullopt;
  std::uint32_t end = at_;
  while (end < end_ && isNameSign(sign(end)))
    ++end;
  if (end < end_ && !isBlank(sign(end)))
    return std::nullopt;
  return Span{at_, end};
}

bool ClauseReader::at(std::string_view keyword) const {
  const std::optional<Span> next = peekName();
  return next && toUpper(text(*next)) == keyword;
}

bool ClauseReader::take(std::string_view keyword) {
  if (!at(keyword))
    return false;
  at_ += static_cast<std::uint32_t>(keyword.size());
  skipBlanks();
  return true;
}

bool ClauseReader::takeSign(char wanted) {
  if (sign(at_) != wanted)
    return false;
  ++at_;
  skipBlanks();
  return true;
}

Span ClauseReader::name(std::string_view what) {
  const std::optional<Span> next = peekName();
  if (!next) {
    expected(std::string(what));
    return {};
  }
  at_ = next->end;
  skipBlanks();
  return *next;
}

std::optional<char> ClauseReader::peekLetter(std::string_view letters) const {
  const char letter = toUpper(sign(at_));
  if (letter == '\0' || letters.find(letter) == std::string_view::npos || isLetter(sign(at_ + 1)))
    return std::nullopt;
  return letter;
}

std::optional<char> ClauseReader::takeLetter(std::string_view letters) {
  const std::optional<char> letter = peekLetter(letters);
  if (letter) {
    ++at_;
    skipBlanks();
  }
  return letter;
}

bool ClauseReader::takeAddress(char letter) {
  if (toUpper(std::string(1, sign(at_)))[0] != letter)
    return false;
  ++at_;
  skipBlanks();
  return true;
}

std::uint32_t ClauseReader::integer(std::string_view what) {
  std::uint32_t end = at_;
  while (isDigit(sign(end)))
    ++end;
  const std::optional<std::uint32_t> number = digitsIn(text({at_, end}));
  if (!number || (end < end_ && !isBlank(sign(end)))) {
    expected(std::string(what));
    return 0;
  }
  at_ = end;
  skipBlanks();
  return *number;
}

ClauseReader::Variable ClauseReader::variable() {
  std::uint32_t end = at_ + 1;
  while (isDigit(sign(end)))
    ++end;
  const std::optional<std::uint32_t> number =
      sign(at_) == '#' ? digitsIn(text({at_ + 1, end})) : std::optional<std::uint32_t>();
  const bool ends = end >= end_ || isBlank(sign(end)) || sign(end) == '.';
  if (!number || !ends) {
    expected("a variable such as `#21`");
    return {};
  }
  const Span span{at_, end};
  at_ = end;
  skipBlanks();
  return {*number, span};
}

std::uint32_t ClauseReader::operandEnd(std::uint32_t begin) const {
  int depth = 0;
  bool pointMayFollow = false; // digits without a point
  for (std::uint32_t i = begin; i < end_; ++i) {
    const char c = sign(i);
    depth += c == '[' ? 1 : c == ']' ? -1 : 0;
    if (depth > 0)
      continue;
    if (isBlank(c) || c == ',')
      return i;
    if (c == '.' && sign(i + 1) == '.') {
      const bool ownPoint = pointMayFollow && sign(i + 2) == '.';
      return ownPoint ? i + 1 : i;
    }
    pointMayFollow = isDigit(c) && (pointMayFollow || i == begin || (!isDigit(sign(i - 1)) && sign(i - 1) != '.'));
  }
  return end_;
}

bool ClauseReader::takeDots() {
  if (sign(at_) != '.' || sign(at_ + 1) != '.')
    return false;
  at_ += 2;
  return true;
}

ExpressionId ClauseReader::value(std::string_view what) {
  const Span part{at_, operandEnd(at_)};
  if (part.empty()) {
    expected(std::string(what));
    return ExpressionId(0);
  }
  at_ = part.end;
  skipBlanks();
  const ExpressionId result = parsed(part, nullptr);
  refuseNumber(result);
  return result;
}

/// Behind `..`: what follows at once, or behind blanks what begins as a number does.  A letter behind blanks begins the
/// next part (`X0.. Z..5`, `1.. MM`), unless blanks in front of `..`, too, say that a function follows.
bool ClauseReader::hasUpperEnd(bool spacedBefore) {
  const std::uint32_t dotsEnd = at_;
  skipBlanks();
  if (atEnd())
    return false;
  const char first = sign(at_);
  if (at_ == dotsEnd || isDigit(first) || first == '#' || first == '[' || first == '-' || first == '+')
    return true;
  if (first == '.')
    return sign(at_ + 1) != '.';
  std::uint32_t nameEnd = at_;
  while (nameEnd < end_ && isLetter(sign(nameEnd)))
    ++nameEnd;
  return spacedBefore && nameEnd - at_ > 1 && nameEnd < end_ && sign(nameEnd) == '[';
}

Range ClauseReader::range(std::string_view what) {
  const std::uint32_t begin = at_;
  const auto bound = [&] {
    const Span part{at_, operandEnd(at_)};
    at_ = part.end;
    const ExpressionId result = parsed(part, nullptr);
    refuseNumber(result);
    return result;
  };
  Range range;
  if (sign(at_) != '.' || sign(at_ + 1) != '.') {
    if (operandEnd(at_) == at_) {
      expected(std::string(what));
      return {};
    }
    range.low = bound();
  }
  // `0...5`: 0. to 5, or 0 to .5
  const bool isAmbiguous = range.low && sign(at_ - 1) == '.' && sign(at_) == '.' && isDigit(sign(at_ + 2));
  const std::uint32_t lowEnd = at_;
  skipBlanks();
  const bool spaced = at_ > lowEnd;
  if (!takeDots()) {
    expected(fmt::format("`..` and the upper end of {}", what));
    return {};
  }
  if (isAmbiguous)
    fail(ContractIssueKind::Malformed, {begin, operandEnd(at_)},
         "a blank before or after `..`, to show which number the third point belongs to");
  if (const std::uint32_t dotsEnd = at_; !hasUpperEnd(spaced))
    at_ = dotsEnd;
  else
    range.high = bound();
  reading_.ranges.push_back({clause_, range, {begin, at_}});
  skipBlanks();
  return range;
}

Range ClauseReader::valueOrRange(std::string_view what) {
  const std::uint32_t end = operandEnd(at_);
  std::uint32_t next = end;
  while (next < end_ && isBlank(sign(next)))
    ++next;
  if (end == at_ || (sign(next) == '.' && sign(next + 1) == '.'))
    return range(what);
  const ExpressionId only = value(what);
  return {only, only};
}

ExpressionId ClauseReader::expression(FindReserved reserved) {
  if (atEnd()) {
    expected("an expression");
    return ExpressionId(0);
  }
  const ExpressionId result = parsed({at_, end_}, reserved);
  at_ = end_;
  refuseNumber(result);
  return result;
}

ExpressionId ClauseReader::condition(FindReserved reserved) {
  if (atEnd()) {
    expected("a condition such as `[#7*2] LT #2`");
    return ExpressionId(0);
  }
  const ExpressionId result = parsed({at_, end_}, reserved);
  at_ = end_;
  refuseCondition(result);
  return result;
}

ExpressionId ClauseReader::parsed(Span part, FindReserved reserved) {
  SyntaxTree &tree = reading_.result.tree;
  const ExpressionId result = parseExpression(tree, source_, part, reading_.dialect, reserved);
  if (!tree.issues.empty())
    refuseSyntax(tree.issues.front());
  tree.issues.clear();
  if (failed())
    return result;
  for (const ExpressionId each : subexpressions(tree, result)) {
    const Expression &expression = tree.expressions[each];
    if (std::holds_alternative<BrokenExpression>(expression.node))
      fail(ContractIssueKind::Expression, part, "a part of it could not be read");
    if (std::holds_alternative<NamedVariable>(expression.node) && sourceId_ != kProgramText)
      fail(ContractIssueKind::Expression, expression.span,
           "names of variables are known only in the program; write the number here, or move the clause into the "
           "program");
  }
  return result;
}

/// `WITHIN`, if it comes at `begin` or after blanks; else empty.
Span ClauseReader::wordOfWithin(std::uint32_t begin) const {
  while (begin < end_ && isBlank(source_.text()[begin]))
    ++begin;
  const Span word{begin, begin + static_cast<std::uint32_t>(kWithin.size())};
  return word.end <= source_.text().size() && toUpper(text(word)) == kWithin ? word : Span{begin, begin};
}

void ClauseReader::refuseSyntax(const SyntaxIssue &issue) {
  const Span word = wordOfWithin(issue.span.begin);
  if (!word.empty())
    return fail(
        ContractIssueKind::Expression, {word.begin, std::max(word.end, issue.span.end)},
        "`WITHIN` stands between a comparison by `EQ` or `NE` and a positive number: `POS[X] EQ #24 WITHIN 0.001`");
  const bool open = issue.kind == SyntaxIssueKind::MissingCloseBracket;
  const bool symbol = issue.kind == SyntaxIssueKind::SymbolicComparison;
  const bool deep = issue.kind == SyntaxIssueKind::NestingTooDeep;
  fail(ContractIssueKind::Expression, issue.span,
       open     ? "`]` is missing here"
       : symbol ? "write comparisons as in the program: `EQ NE GT GE LT LE`"
       : deep   ? "it is too long, or nested too deep"
                : "an operand of the macro language was expected here");
}

/// Every comparison has numbers on both sides: `#1 LT 5 AND #2 GT 3` compares something else than it seems.
void ClauseReader::refuseCondition(ExpressionId id) {
  if (failed())
    return;
  const SyntaxTree &tree = reading_.result.tree;
  const Expression &expression = tree.expressions[unwrapped(tree, id)];
  const auto *operation = std::get_if<BinaryOperation>(&expression.node);
  const bool joins = operation && (operation->op == OperatorKind::And || operation->op == OperatorKind::Or ||
                                   operation->op == OperatorKind::Xor);
  if (!operation || (!joins && !isRelation(operation->op)))
    return fail(ContractIssueKind::Expression, expression.span, "a comparison was expected, such as `#2 GT 0`");
  const auto refuse = joins ? &ClauseReader::refuseCondition : &ClauseReader::refuseNumber;
  const ExpressionId left = operation->left;
  const ExpressionId right = operation->right;
  (this->*refuse)(left);
  (this->*refuse)(right);
}

void ClauseReader::refuseNumber(ExpressionId id) {
  if (failed())
    return;
  for (const ExpressionId each : subexpressions(reading_.result.tree, id)) {
    const Expression &expression = reading_.result.tree.expressions[each];
    const auto *operation = std::get_if<BinaryOperation>(&expression.node);
    if (operation && isRelation(operation->op))
      return fail(ContractIssueKind::Expression, expression.span,
                  "each comparison needs its own brackets: `[#1 GT 0] AND [#2 GT 0]`");
  }
}

} // namespace feedhold
