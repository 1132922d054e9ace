// expression-in-parentheses: `#1=(#2+1)*2`, `IF(#1EQ0)`.
#include "findings/rule/rule.h"

#include "language/lex/lexer.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules {
namespace {

constexpr TokenKind kOfExpressions[] = {
    TokenKind::Number,       TokenKind::Function, TokenKind::Operator, TokenKind::Hash,   TokenKind::OpenBracket,
    TokenKind::CloseBracket, TokenKind::Plus,     TokenKind::Minus,    TokenKind::Star,   TokenKind::Slash,
    TokenKind::Comma,        TokenKind::Equals,   TokenKind::Less,     TokenKind::Greater};
constexpr TokenKind kBeforeOperand[] = {TokenKind::Equals, TokenKind::Plus,       TokenKind::Minus, TokenKind::Star,
                                        TokenKind::Slash,  TokenKind::Operator,   TokenKind::Hash,  TokenKind::Function,
                                        TokenKind::Comma,  TokenKind::OpenBracket};
constexpr TokenKind kStartsOperand[] = {TokenKind::Number, TokenKind::Function, TokenKind::Hash,
                                        TokenKind::OpenBracket};

template <std::size_t Count> bool isOneOf(TokenKind kind, const TokenKind (&kinds)[Count]) {
  return std::find(std::begin(kinds), std::end(kinds), kind) != std::end(kinds);
}

/// Nothing but operands and operators, at least one.
bool looksLikeExpression(std::string_view inside) {
  Lexer lexer(inside);
  Token token = lexer.next();
  const bool some = token.kind != TokenKind::EndOfFile;
  while (isOneOf(token.kind, kOfExpressions))
    token = lexer.next();
  return some && token.kind == TokenKind::EndOfFile;
}

std::optional<Token> lastToken(std::string_view text) {
  std::optional<Token> last;
  Lexer lexer(text);
  for (Token token = lexer.next(); token.kind != TokenKind::EndOfFile; token = lexer.next())
    if (token.kind != TokenKind::Comment)
      last = token;
  return last;
}

bool wantsOperand(const Token &token) {
  if (token.kind == TokenKind::Address)
    return token.letter() != 'N' && token.letter() != 'O';
  if (token.kind == TokenKind::ControlWord)
    return token.controlWord() == ControlWord::If || token.controlWord() == ControlWord::While ||
           token.controlWord() == ControlWord::Goto;
  return isOneOf(token.kind, kBeforeOperand);
}

void check(const Comment &comment, BlockId block, const FileContext &context, const Reporter &reporter) {
  const Span inside{comment.span.begin + 1, comment.span.end - 1};
  if (!comment.closed || !looksLikeExpression(context.text(inside)))
    return;
  const Span line = context.tree.blocks[block].span();
  const auto before = lastToken(context.text({line.begin, comment.span.begin}));
  const Token after = Lexer(context.text({comment.span.end, line.end})).next();
  if (!before || !wantsOperand(*before) || isOneOf(after.kind, kStartsOperand))
    return;
  reporter.report(
      {.message = fmt::format("{} is a comment, not an expression", context.quoted(comment.span)),
       .span = comment.span,
       .notes = {"the control reads past parentheses; an operand is missing here", "brackets group: `[#1+2]`"},
       .fixes = {{.title = "write brackets",
                  .edits = {{{comment.span.begin, inside.begin}, "["}, {{inside.end, comment.span.end}, "]"}}}}});
}

} // namespace

extern const Rule expressionInParentheses;
const Rule expressionInParentheses{
    .info = {"expression-in-parentheses", Category::Expression, Severity::Error,
             "Reports an expression in parentheses where brackets are meant: to the control it is a comment."},
    .hooks = {.comment = check}};

} // namespace feedhold::rules
