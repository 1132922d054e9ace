// Expressions, by precedence climbing; the precedences are the dialect's.
#include "base/support/text.h"
#include "language/parse/parser.h"

namespace feedhold {

ExpressionId parseExpression(SyntaxTree &tree, const SourceFile &source, Span part, const Dialect &dialect,
                             FindReserved reserved) {
  return Parser(source.text().substr(0, part.end), dialect).runExpression(tree, part.begin, reserved);
}

ExpressionId Parser::runExpression(SyntaxTree &tree, std::uint32_t begin, FindReserved reserved) {
  std::swap(tree, tree_);
  reserved_ = reserved;
  inContract_ = true;
  symbolicAllowed_ = true;
  moveTo(begin);
  const ExpressionId result = expression();
  if (!at(TokenKind::EndOfFile))
    issue(SyntaxIssueKind::BrokenExpression, token_.span(), {}, Broken::Yes);
  std::swap(tree, tree_);
  return result;
}

ExpressionId Parser::expression() { return binary(1); }

ExpressionId Parser::binary(int lowestPrecedence) { return binaryRest(operand(), lowestPrecedence); }

ExpressionId Parser::binaryRest(ExpressionId left, int lowestPrecedence) {
  while (const std::optional<OperatorKind> op = peekOperator()) {
    const int precedence = precedence_[static_cast<std::size_t>(*op)];
    // `.. /M08`: behind an expression without brackets a slash before a word is a block skip.
    const bool skip = at(TokenKind::Slash) && !symbolicAllowed_ && !startsOperand(peek());
    if (precedence < lowestPrecedence || skip || broken_)
      break;
    if (++operatorsInBlock_ > kMostOperators) {
      expressionTooDeep();
      break;
    }
    const std::uint32_t opBegin = token_.begin;
    const OperatorKind taken = takeOperator(*op);
    const Span opSpan = since(opBegin);
    const ExpressionId right = binary(precedence + 1);
    const BinaryOperation operation{taken, left, right, opSpan};
    left = atWithin(taken) ? within(operation) : addExpression(spanOf(left).begin, operation);
  }
  return left;
}

/// Outside brackets a `/` is a block skip.  A control that takes sums in brackets alone has block skips at the head of
/// a block alone: before a value, a `/` further on was meant to divide.
bool Parser::slashCanDivide() const {
  return !at(TokenKind::Slash) || (grammar_.valueNeedsBrackets && startsOperand(peek()));
}

bool Parser::atWithin(OperatorKind relation) const {
  return inContract_ && (relation == OperatorKind::Equal || relation == OperatorKind::NotEqual) &&
         toUpper(text_.substr(token_.begin, kWithin.size())) == kWithin;
}

/// `a EQ b WITHIN t` is `ABS[a-b] LE t`, and `a NE b WITHIN t` is `ABS[a-b] GT t`, so that no interpretation of the
/// tree has to know of tolerances.
ExpressionId Parser::within(const BinaryOperation &relation) {
  const std::uint32_t begin = spanOf(relation.left).begin;
  const Span compared{begin, spanOf(relation.right).end};
  const Span word{token_.begin, token_.begin + static_cast<std::uint32_t>(kWithin.size())};
  moveTo(word.end);
  const ExpressionId most = at(TokenKind::Number) ? number() : addExpression(word.end, BrokenExpression{});
  const auto value = literalValue(tree_, most);
  if (!value || value->isZero())
    issue(SyntaxIssueKind::BrokenExpression, since(word.begin), {}, Broken::Yes);
  const ExpressionId difference = tree_.expressions.add(
      {compared, BinaryOperation{OperatorKind::Subtract, relation.left, relation.right, relation.opSpan}});
  FunctionCall distance(FunctionKind::Abs);
  distance.add(difference);
  const ExpressionId left = tree_.expressions.add({compared, distance});
  const OperatorKind op = relation.op == OperatorKind::Equal ? OperatorKind::LessOrEqual : OperatorKind::GreaterThan;
  return addExpression(begin, BinaryOperation{op, left, most, word});
}

std::optional<OperatorKind> Parser::peekOperator() const {
  switch (token_.kind) {
  case TokenKind::Plus: return OperatorKind::Add;
  case TokenKind::Minus: return OperatorKind::Subtract;
  case TokenKind::Star: return OperatorKind::Multiply;
  case TokenKind::Slash: return OperatorKind::Divide;
  case TokenKind::Operator: return token_.op();
  case TokenKind::Equals: return symbolicAllowed_ ? std::optional(OperatorKind::Equal) : std::nullopt;
  case TokenKind::Less: return symbolicAllowed_ ? std::optional(OperatorKind::LessThan) : std::nullopt;
  case TokenKind::Greater: return symbolicAllowed_ ? std::optional(OperatorKind::GreaterThan) : std::nullopt;
  case TokenKind::EndOfFile:
  case TokenKind::EndOfBlock:
  case TokenKind::Address:
  case TokenKind::Number:
  case TokenKind::Function:
  case TokenKind::ControlWord:
  case TokenKind::OWord:
  case TokenKind::Hash:
  case TokenKind::OpenBracket:
  case TokenKind::CloseBracket:
  case TokenKind::Comma:
  case TokenKind::Colon:
  case TokenKind::Percent:
  case TokenKind::Comment:
  case TokenKind::CloseParenthesis:
  case TokenKind::Name:
  case TokenKind::Other: return std::nullopt;
  }
  return std::nullopt;
}

/// Takes the operator that peekOperator saw.  `=`, `<`, `>=`, `<>` and `LT=` are read as the relation that is meant.
OperatorKind Parser::takeOperator(OperatorKind op) {
  if (at(TokenKind::Equals) || at(TokenKind::Less) || at(TokenKind::Greater))
    return takeSymbolicComparison();
  const Token taken = token_;
  advance();
  if (!isRelation(op) || !at(TokenKind::Equals))
    return op;
  advance();
  issue(SyntaxIssueKind::SymbolicComparison, since(taken.begin), {}, Broken::No);
  return op == OperatorKind::LessThan      ? OperatorKind::LessOrEqual
         : op == OperatorKind::GreaterThan ? OperatorKind::GreaterOrEqual
                                           : op;
}

OperatorKind Parser::takeSymbolicComparison() {
  const std::uint32_t begin = token_.begin;
  bool less = false, greater = false, equals = false;
  for (; at(TokenKind::Equals) || at(TokenKind::Less) || at(TokenKind::Greater); advance()) {
    less = less || at(TokenKind::Less);
    greater = greater || at(TokenKind::Greater);
    equals = equals || at(TokenKind::Equals);
  }
  issue(SyntaxIssueKind::SymbolicComparison, since(begin), {}, Broken::No);
  if (less && greater)
    return OperatorKind::NotEqual;
  if (less)
    return equals ? OperatorKind::LessOrEqual : OperatorKind::LessThan;
  if (greater)
    return equals ? OperatorKind::GreaterOrEqual : OperatorKind::GreaterThan;
  return OperatorKind::Equal;
}

bool Parser::startsOperand(const Token &token) const {
  return token.kind == TokenKind::Number || token.kind == TokenKind::Hash || token.kind == TokenKind::OpenBracket ||
         token.kind == TokenKind::Function || token.kind == TokenKind::Minus || token.kind == TokenKind::Plus;
}

ExpressionId Parser::operand() {
  if (++depth_ > kDeepestNesting) {
    --depth_;
    return expressionTooDeep();
  }
  const ExpressionId result = operandInside();
  --depth_;
  return result;
}

ExpressionId Parser::expressionTooDeep() {
  const std::uint32_t begin = token_.begin;
  issue(SyntaxIssueKind::NestingTooDeep, token_.span(), {}, Broken::Yes);
  while (!atEnd() && !at(TokenKind::Comment))
    advance();
  return addExpression(begin, BrokenExpression{});
}

ExpressionId Parser::operandInside() {
  const std::uint32_t begin = token_.begin;
  switch (token_.kind) {
  case TokenKind::Number: return number();
  case TokenKind::Hash: return variable();
  case TokenKind::OpenBracket: return bracketed();
  case TokenKind::Function: return functionCall();
  case TokenKind::Minus: {
    advance();
    const ExpressionId inner = operand();
    return addExpression(begin, Negation{inner});
  }
  case TokenKind::Plus: {
    advance();
    const ExpressionId inner = operand();
    return addExpression(begin, Identity{inner});
  }
  case TokenKind::Address:
  case TokenKind::Other: return unknownOperand();
  case TokenKind::EndOfFile:
  case TokenKind::EndOfBlock:
  case TokenKind::Operator:
  case TokenKind::ControlWord:
  case TokenKind::OWord:
  case TokenKind::CloseBracket:
  case TokenKind::Star:
  case TokenKind::Slash:
  case TokenKind::Equals:
  case TokenKind::Comma:
  case TokenKind::Colon:
  case TokenKind::Percent:
  case TokenKind::Comment:
  case TokenKind::CloseParenthesis:
  case TokenKind::Name:
  case TokenKind::Less:
  case TokenKind::Greater: return brokenOperand();
  }
  return brokenOperand();
}

ExpressionId Parser::unknownOperand() {
  const std::uint32_t begin = token_.begin;
  const auto found = reserved_ ? reserved_(text_.substr(begin)) : std::nullopt;
  if (!found)
    return brokenOperand();
  moveTo(begin + found->length);
  return addExpression(begin, NumberedVariable{found->variable});
}

namespace {

/// Nothing but operands and operators, at least one.
bool looksLikeExpression(std::string_view text, const Grammar &grammar) {
  Lexer lexer(text, grammar);
  std::size_t count = 0;
  for (Token token = lexer.next(); token.kind != TokenKind::EndOfFile; token = lexer.next(), ++count) {
    const bool fits = token.kind == TokenKind::Number || token.kind == TokenKind::Function ||
                      (token.kind >= TokenKind::Operator && token.kind <= TokenKind::Comma &&
                       token.kind != TokenKind::ControlWord && token.kind != TokenKind::OWord) ||
                      token.kind == TokenKind::Less || token.kind == TokenKind::Greater;
    if (!fits)
      return false;
  }
  return count > 0;
}

} // namespace

/// `(#2+1)` where an operand is missing: the parentheses of other languages, read as a comment just before token_.
/// Reported, and the block given up.
bool Parser::expressionInParentheses() {
  if (tree_.comments.size() == block_.firstComment.index())
    return false;
  const Comment &comment = tree_.comments[CommentId(tree_.comments.size() - 1)];
  const Span span = comment.span;
  if (!comment.closed || span.begin < lastEnd_ ||
      !looksLikeExpression(text_.substr(span.begin + 1, span.size() - 2), grammar_))
    return false;
  issue(SyntaxIssueKind::ExpressionInParentheses, span, {}, Broken::Yes);
  return true;
}

ExpressionId Parser::brokenOperand() {
  if (expressionInParentheses())
    return tree_.expressions.add(Expression{{lastEnd_, lastEnd_}, BrokenExpression{}});
  const bool nothing = atEnd() || at(TokenKind::Comment);
  issue(SyntaxIssueKind::BrokenExpression, nothing ? Span{lastEnd_, lastEnd_} : token_.span(), {}, Broken::Yes);
  return tree_.expressions.add(Expression{{lastEnd_, lastEnd_}, BrokenExpression{}});
}

ExpressionId Parser::number() {
  const Token token = token_;
  const std::optional<Decimal> value = numberHere();
  advance();
  if (!value)
    return addExpression(token.begin, BrokenExpression{});
  return addExpression(token.begin, NumberLiteral{*value});
}

/// `#101`, `#[..]`, `#<name>`, `##1` (reported where the control does not read it).
ExpressionId Parser::variable() {
  const Token hash = token_;
  advance();
  if (at(TokenKind::Number)) {
    const std::optional<Decimal> number = numberHere();
    advance();
    if (!number)
      return addExpression(hash.begin, BrokenExpression{});
    return addExpression(hash.begin, NumberedVariable{*number});
  }
  if (at(TokenKind::Name)) {
    const Span name{token_.begin + 1, token_.end - 1};
    advance();
    return addExpression(hash.begin, NamedVariable{name});
  }
  if (at(TokenKind::OpenBracket) && startsName(token_.end))
    return namedVariable(hash.begin, token_.end);
  if (at(TokenKind::Hash) && !grammar_.anyIndex)
    issue(SyntaxIssueKind::DoubleHash, {hash.begin, token_.end}, {}, Broken::No);
  else if (!at(TokenKind::OpenBracket) && !(grammar_.anyIndex ? startsOperand(token_) : at(TokenKind::Hash)))
    return brokenOperand();
  const ExpressionId index = operand();
  return addExpression(hash.begin, IndirectVariable{index});
}

ExpressionId Parser::bracketed() {
  const Token open = token_;
  if (open.end < text_.size() && text_[open.end] == '#' && startsName(open.end + 1))
    return namedVariable(open.begin, open.end + 1);
  advance();
  const bool outer = std::exchange(symbolicAllowed_, true);
  const ExpressionId inner = expression();
  symbolicAllowed_ = outer;
  closeBracket(open);
  return addExpression(open.begin, Bracketed{inner});
}

/// A letter or `_` that begins a name, not a function: `#[WIDTH]`, but `#[ABS[#1]]`.
bool Parser::startsName(std::uint32_t offset) const {
  if (offset >= text_.size() || (!isLetter(text_[offset]) && text_[offset] != '_'))
    return false;
  Lexer ahead = lexer_;
  ahead.moveTo(offset);
  return ahead.next().kind != TokenKind::Function || ahead.next().kind != TokenKind::OpenBracket;
}

/// `[#_ALM]`, `[#_UI[3]]`, `[#WIDTH]`, `#[WIDTH]`; token_ is the outer bracket.
ExpressionId Parser::namedVariable(std::uint32_t begin, std::uint32_t nameBegin) {
  const Token open = token_;
  const std::optional<std::uint32_t> close = lexer_.closingBracket(open.begin);
  if (!close) {
    issue(SyntaxIssueKind::MissingCloseBracket, {open.end, open.end}, open.span(), Broken::Yes);
    return brokenOperand();
  }
  moveTo(*close + 1);
  return addExpression(begin, NamedVariable{{nameBegin, *close}});
}

/// `SQRT[a]`, `ATAN[a]/[b]`, `ATAN[a,b]`, `PRM[n,b]/[x]`.
ExpressionId Parser::functionCall() {
  const Token name = token_;
  FunctionCall call(name.function());
  advance();
  if (!at(TokenKind::OpenBracket)) {
    if (!expressionInParentheses())
      issue(SyntaxIssueKind::MissingOpenBracket, {lastEnd_, lastEnd_}, name.span(), Broken::No);
    call.add(operand());
    return addExpression(name.begin, call);
  }
  const Token open = token_;
  advance();
  const bool outer = std::exchange(symbolicAllowed_, true);
  call.add(expression());
  while (at(TokenKind::Comma) && !broken_ && call.takesMore()) {
    advance();
    call.add(expression());
  }
  symbolicAllowed_ = outer;
  closeBracket(open);
  // Behind ATAN[..] and PRM[..] a slash with a bracket is the second argument, even where a division was meant.
  const bool takesSlash = call.function == FunctionKind::Atan || call.function == FunctionKind::Prm;
  if (takesSlash && at(TokenKind::Slash) && peek().kind == TokenKind::OpenBracket && call.takesMore() && !broken_) {
    advance();
    call.add(operand());
    call.slash = true;
  }
  return addExpression(name.begin, call);
}

void Parser::closeBracket(const Token &open) {
  if (at(TokenKind::CloseBracket)) {
    advance();
    return;
  }
  // With a closing bracket further on, the text between is what is wrong; else the bracket is missing here.
  const std::string_view rest = text_.substr(token_.begin, kRecoveryWindow);
  const std::size_t stop = rest.find_first_of("](\r\n");
  const bool closedLater = stop != std::string_view::npos && rest[stop] == ']' && !atEnd();
  const bool readsOn = atEnd() || at(TokenKind::Comment) || at(TokenKind::ControlWord);
  if (closedLater)
    issue(SyntaxIssueKind::BrokenExpression, token_.span(), {}, Broken::Yes);
  else
    issue(SyntaxIssueKind::MissingCloseBracket, {lastEnd_, lastEnd_}, open.span(), readsOn ? Broken::No : Broken::Yes);
  block_.flags |= Block::kBroken;
}

ExpressionId Parser::addExpression(std::uint32_t begin, decltype(Expression::node) node) {
  return tree_.expressions.add(Expression{since(begin), std::move(node)});
}

} // namespace feedhold
