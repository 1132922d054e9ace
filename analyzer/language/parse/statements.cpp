// Macro statements.
#include "base/support/check.h"
#include "base/support/text.h"
#include "language/parse/parser.h"

#include <algorithm>

namespace feedhold {

void Parser::readStatement() {
  const Token first = token_;
  if (text_[first.begin] >= 'a' && text_[first.begin] <= 'z')
    lowerCase_ = lowerCase_ ? cover(*lowerCase_, first.span()) : first.span();
  commentsAreBlanks_ = true;
  const StatementId statement = at(TokenKind::ControlWord) ? controlStatement()
                                : at(TokenKind::Address)   ? oWordStatement()
                                                           : variableStatement();
  commentsAreBlanks_ = false;
  headOfBlock_ = false;
  addTopStatement(statement);
}

void Parser::addTopStatement(StatementId statement) {
  const Span span = tree_.statements[statement].span;
  if (statementInBlock_)
    issue(SyntaxIssueKind::TwoStatements, span, *statementInBlock_, Broken::No);
  else
    statementInBlock_ = span;
}

/// `#1=..`, `[#NAME]=..`, or an expression that lacks its `=`; also `[#1 LT 2] M99`.
StatementId Parser::variableStatement() {
  const std::uint32_t begin = token_.begin;
  const bool bracket = at(TokenKind::OpenBracket);
  const ExpressionId target = operand();
  if (at(TokenKind::Equals)) {
    advance();
    const ExpressionId value = grammar_.valueNeedsBrackets ? assignedValue(begin) : expression();
    return addStatement(begin, Assignment{target, value});
  }
  if (bracket && at(TokenKind::Address)) {
    wordFlags_ |= Word::kAfterThen;
    return addStatement(begin, ConditionalWords{target});
  }
  const Span sign = peekOperator() ? token_.span() : Span{lastEnd_, lastEnd_};
  ExpressionId whole = target;
  if (peekOperator())
    whole = binaryRest(target, 1);
  else if (startsOperand(token_))
    expression();
  issue(SyntaxIssueKind::MissingEquals, sign, since(begin), Broken::No);
  return addStatement(begin, LoneExpression{whole});
}

/// The value where a sum needs brackets: `#1=#2+1` is read, and reported.
ExpressionId Parser::assignedValue(std::uint32_t begin) {
  const ExpressionId value = operand();
  if (!peekOperator() || !slashCanDivide() || broken_)
    return value;
  const std::uint32_t from = token_.begin;
  const ExpressionId whole = binaryRest(value, 1);
  issue(SyntaxIssueKind::UnbracketedExpression, since(from), since(begin), Broken::No);
  return whole;
}

StatementId Parser::controlStatement() {
  switch (token_.controlWord()) {
  case ControlWord::If: return ifStatement();
  case ControlWord::While: return whileStatement();
  case ControlWord::Do:
  case ControlWord::End: return loopStatement();
  case ControlWord::Goto: return gotoStatement();
  case ControlWord::SetVn: return nameVariablesStatement();
  case ControlWord::Popen:
  case ControlWord::Pclos:
  case ControlWord::Dprnt:
  case ControlWord::Bprnt: return printStatement();
  case ControlWord::Then: {
    issue(SyntaxIssueKind::ThenWithoutIf, token_.span(), {}, Broken::Yes);
    return keywordOnly(BrokenStatement{});
  }
  case ControlWord::Else: return keywordOnly(Else{});
  case ControlWord::EndIf: return keywordOnly(EndIf{});
  case ControlWord::ElseIf: {
    const Token keyword = token_;
    advance();
    const auto test = condition(keyword, SyntaxIssueKind::IfWithoutCondition);
    if (at(ControlWord::Then))
      advance();
    return addStatement(keyword.begin, ElseIf{test});
  }
  }
  FEEDHOLD_UNREACHABLE("the switch names every control word");
}

StatementId Parser::keywordOnly(decltype(Statement::node) node) {
  const std::uint32_t begin = token_.begin;
  advance();
  return addStatement(begin, std::move(node));
}

StatementId Parser::ifStatement() {
  const Token keyword = token_;
  advance();
  If statement{condition(keyword, SyntaxIssueKind::IfWithoutCondition), IfAction::Nothing, std::nullopt, false};
  takeStrayCloseBrackets(Broken::No);
  statement.statement = ifAction(statement, keyword);
  return addStatement(keyword.begin, statement);
}

/// Reads what stands behind the condition of an IF and says so in `statement`; the statement of it, if there is one.
std::optional<StatementId> Parser::ifAction(If &statement, const Token &keyword) {
  if (broken_)
    return std::nullopt;
  const Span condition = since(keyword.begin);
  const Token then = token_;
  statement.hasThen = at(ControlWord::Then);
  if (statement.hasThen)
    advance();
  if (at(ControlWord::Goto)) {
    if (statement.hasThen)
      issue(SyntaxIssueKind::ThenWithGoto, token_.span(), then.span(), Broken::No);
    statement.action = IfAction::Jump;
    const StatementId jump = gotoStatement();
    tree_.statements[jump].nested = true;
    return jump;
  }
  if (atEnd() || at(TokenKind::Comment)) {
    statement.action = statement.hasThen ? IfAction::Lines : IfAction::Nothing;
    issue(statement.hasThen ? SyntaxIssueKind::ThenWithoutStatement : SyntaxIssueKind::IfWithoutAction,
          statement.hasThen ? then.span() : condition, condition, Broken::No);
    return std::nullopt;
  }
  if (!statement.hasThen)
    issue(SyntaxIssueKind::IfWithoutThen, token_.span(), condition, Broken::No);
  if (at(TokenKind::Address) || at(TokenKind::Comma)) {
    if (statement.hasThen)
      issue(SyntaxIssueKind::ThenWithWords, token_.span(), then.span(), Broken::No);
    statement.action = IfAction::Words;
    wordFlags_ |= Word::kAfterThen;
    return std::nullopt;
  }
  const bool startsStatement = at(TokenKind::Hash) || at(TokenKind::OpenBracket) || at(TokenKind::ControlWord);
  if (!startsStatement) {
    issue(SyntaxIssueKind::UnexpectedText, token_.span(), {}, Broken::Yes);
    return std::nullopt;
  }
  statement.action = IfAction::Statement;
  if (++depth_ > kDeepestNesting) { // IF [..] THEN IF [..] THEN .. without end
    issue(SyntaxIssueKind::NestingTooDeep, token_.span(), {}, Broken::Yes);
    --depth_;
    return std::nullopt;
  }
  const StatementId action = at(TokenKind::ControlWord) ? controlStatement() : variableStatement();
  --depth_;
  tree_.statements[action].nested = true;
  return action;
}

StatementId Parser::whileStatement() {
  const Token keyword = token_;
  advance();
  const auto test = condition(keyword, SyntaxIssueKind::WhileWithoutCondition);
  takeStrayCloseBrackets(Broken::No);
  if (!at(ControlWord::Do)) {
    issue(SyntaxIssueKind::WhileWithoutDo, since(keyword.begin), {}, Broken::Yes);
    return addStatement(keyword.begin, While{test, std::nullopt});
  }
  return addStatement(keyword.begin, While{test, loopNumber()});
}

StatementId Parser::loopStatement() {
  const std::uint32_t begin = token_.begin;
  const bool isDo = at(ControlWord::Do);
  const auto number = loopNumber();
  return isDo ? addStatement(begin, Do{number}) : addStatement(begin, End{number});
}

/// The number behind DO or END, on which token_ stands.
std::optional<ExpressionId> Parser::loopNumber() {
  const Token keyword = token_;
  advance();
  if (startsOperand(token_))
    return operand();
  issue(SyntaxIssueKind::DoWithoutNumber, keyword.span(), {}, Broken::No);
  return std::nullopt;
}

StatementId Parser::gotoStatement() {
  const Token keyword = token_;
  advance();
  if (startsOperand(token_))
    return addStatement(keyword.begin, Goto{operand()});
  if (expressionInParentheses())
    return addStatement(keyword.begin, Goto{});
  issue(SyntaxIssueKind::GotoWithoutTarget, keyword.span(), {}, Broken::No);
  // `GOTO N100`: what is meant is plain; the N is what is wrong.
  if (at(TokenKind::Address) && token_.letter() == 'N' && peek().kind == TokenKind::Number) {
    advance();
    return addStatement(keyword.begin, Goto{operand()});
  }
  return addStatement(keyword.begin, Goto{});
}

/// The condition of IF or WHILE.  Brackets are required; what stands without them is read all the same.
std::optional<ExpressionId> Parser::condition(const Token &keyword, SyntaxIssueKind whenMissing) {
  if (!startsOperand(token_)) {
    if (!expressionInParentheses())
      issue(whenMissing, keyword.span(), {}, Broken::No);
    return std::nullopt;
  }
  const bool outer = std::exchange(symbolicAllowed_, true);
  const bool bracket = at(TokenKind::OpenBracket);
  const std::uint32_t begin = token_.begin;
  const ExpressionId first = operand();
  // `IF [a] AND [b] THEN`: relations joined outside of brackets.
  const ExpressionId whole = binaryRest(first, 1);
  if (!bracket)
    issue(SyntaxIssueKind::MissingOpenBracket, {begin, begin}, keyword.span(), Broken::No);
  symbolicAllowed_ = outer;
  return whole;
}

/// `]` without its `[`: reported once, read over.
void Parser::takeStrayCloseBrackets(Broken broken) {
  if (!at(TokenKind::CloseBracket))
    return;
  issue(SyntaxIssueKind::StrayCloseBracket, token_.span(), {}, broken);
  block_.flags |= Block::kBroken;
  const std::uint32_t begin = token_.begin;
  while (at(TokenKind::CloseBracket))
    advance();
  addStatement(begin, BrokenStatement{});
}

/// `SETVN 500[ABC,DEF]`
StatementId Parser::nameVariablesStatement() {
  const Token keyword = token_;
  advance();
  std::optional<ExpressionId> first;
  if (startsOperand(token_) && !at(TokenKind::OpenBracket))
    first = operand();
  const auto close = at(TokenKind::OpenBracket) ? lexer_.closingBracket(token_.begin) : std::nullopt;
  if (!first || !close) {
    issue(SyntaxIssueKind::StatementFormat, since(keyword.begin), {}, Broken::Yes);
    return addStatement(keyword.begin, NameVariables{first, {lastEnd_, lastEnd_}});
  }
  const Span names{token_.end, *close};
  moveTo(*close + 1);
  return addStatement(keyword.begin, NameVariables{first, names});
}

/// POPEN, PCLOS, or `DPRNT[..]`, whose brackets hold text, `*` for blanks, and `X#1[44]`.
StatementId Parser::printStatement() {
  const Token keyword = token_;
  const ControlWord word = keyword.controlWord();
  advance();
  Print print{
      word, {lastEnd_, lastEnd_}, ExpressionId(tree_.expressions.size()), ExpressionId(tree_.expressions.size())};
  if (word == ControlWord::Popen || word == ControlWord::Pclos)
    return addStatement(keyword.begin, print);
  const auto close = at(TokenKind::OpenBracket) ? lexer_.closingBracket(token_.begin) : std::nullopt;
  if (!close) {
    issue(SyntaxIssueKind::StatementFormat, keyword.span(), {}, Broken::Yes);
    return addStatement(keyword.begin, print);
  }
  print.format = {token_.end, *close};
  readPrintedVariables(print.format);
  print.lastVariable = ExpressionId(tree_.expressions.size());
  moveTo(*close + 1);
  return addStatement(keyword.begin, print);
}

void Parser::readPrintedVariables(Span format) {
  const std::string_view upToEnd = text_.substr(0, format.end);
  for (std::size_t hash = upToEnd.find('#', format.begin); hash != std::string_view::npos;
       hash = upToEnd.find('#', hash)) {
    moveTo(static_cast<std::uint32_t>(hash));
    operand();
    hash = std::max<std::size_t>(lastEnd_, hash + 1);
  }
}

StatementId Parser::addStatement(std::uint32_t begin, decltype(Statement::node) node) {
  return tree_.statements.add(Statement{since(begin), false, std::move(node)});
}

} // namespace feedhold
