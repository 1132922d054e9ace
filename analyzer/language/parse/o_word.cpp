// O-words of RS274NGC: `o100 while [#1 lt 5]`, `o<name> call [1] [2]`.  The label is a number, a name in `<>`, a
// variable or a bracket.  Which argument takes what: LinuxCNC's G-code overview, chapter O-codes.
#include "language/parse/parser.h"

namespace feedhold {

namespace {

/// How many bracketed values may stand behind the word.
struct Places {
  std::uint32_t least;
  std::uint32_t most;
};

Places placesOf(OWordKind kind) {
  constexpr std::uint32_t kAnyNumber = 0xffffffff;
  switch (kind) {
  case OWordKind::If:
  case OWordKind::ElseIf:
  case OWordKind::While:
  case OWordKind::Repeat: return {1, 1};
  case OWordKind::Call: return {0, kAnyNumber};
  case OWordKind::Return:
  case OWordKind::Else: // it is read, and means nothing
  case OWordKind::EndSub: return {0, 1};
  case OWordKind::Sub:
  case OWordKind::EndIf:
  case OWordKind::EndWhile:
  case OWordKind::Do:
  case OWordKind::EndRepeat:
  case OWordKind::Break:
  case OWordKind::Continue: return {0, 0};
  }
  return {0, 0};
}

SyntaxIssueKind issueWithoutValue(OWordKind kind) {
  return kind == OWordKind::While    ? SyntaxIssueKind::WhileWithoutCondition
         : kind == OWordKind::Repeat ? SyntaxIssueKind::BrokenExpression
                                     : SyntaxIssueKind::IfWithoutCondition;
}

} // namespace

/// An `O` with a label and an o-word; a number or a name alone is the head of a program.
bool Parser::atOWord() const {
  if (!grammar_.oWords || !at(TokenKind::Address) || token_.letter() != 'O')
    return false;
  Lexer ahead = lexer_;
  const Token label = ahead.next();
  if (label.kind == TokenKind::Number || label.kind == TokenKind::Name)
    return ahead.next().kind == TokenKind::OWord;
  return label.kind == TokenKind::Hash || label.kind == TokenKind::OpenBracket;
}

/// Alone in its block: before it only N and a block skip, behind it comments.
StatementId Parser::oWordStatement() {
  const std::uint32_t begin = token_.begin;
  const bool atHead = headOfBlock_;
  if (!atHead)
    issue(SyntaxIssueKind::UnexpectedText, token_.span(), {}, Broken::Yes);
  advance();
  if (!atHead)
    return addStatement(begin, BrokenStatement{});
  OWord oWord{OWordKind::Sub, token_.span(), std::nullopt, 0, 0};
  if (at(TokenKind::Number) || at(TokenKind::Name)) {
    advance();
  } else {
    oWord.computed = operand();
    oWord.label = spanOf(*oWord.computed);
  }
  if (!at(TokenKind::OWord)) {
    issue(SyntaxIssueKind::UnexpectedText, atEnd() ? since(begin) : token_.span(), {}, Broken::Yes);
    return addStatement(begin, BrokenStatement{});
  }
  const Token keyword = token_;
  oWord.kind = keyword.oWord();
  advance();
  readOWordArguments(oWord, keyword);
  if (!atEnd() && !at(TokenKind::Comment))
    issue(SyntaxIssueKind::UnexpectedText, token_.span(), {}, Broken::Yes);
  return addStatement(begin, oWord);
}

void Parser::readOWordArguments(OWord &oWord, const Token &keyword) {
  const Places places = placesOf(oWord.kind);
  std::vector<ExpressionId> arguments;
  while (at(TokenKind::OpenBracket) && !broken_ && arguments.size() < places.most && ++itemsInBlock_ <= kMostItems)
    arguments.push_back(operand());
  if (arguments.size() < places.least)
    issue(issueWithoutValue(oWord.kind), keyword.span(), {}, Broken::No);
  oWord.firstArgument = static_cast<std::uint32_t>(tree_.oWordArguments.size());
  oWord.argumentCount = static_cast<std::uint32_t>(arguments.size());
  tree_.oWordArguments.insert(tree_.oWordArguments.end(), arguments.begin(), arguments.end());
}

} // namespace feedhold
