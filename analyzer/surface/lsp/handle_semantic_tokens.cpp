// The kinds of the parts of a text, for colours that know more than a pattern can.
#include "base/support/text.h"
#include "language/lex/lexer.h"
#include "surface/lsp/feature_handlers.h"
#include "surface/lsp/feature_json.h"

#include <array>
#include <charconv>

namespace feedhold::lsp {

namespace {

enum class Kind : std::uint8_t {
  Comment,
  Keyword,
  Function,
  Operator,
  Variable,
  Parameter,
  Number,
  Label,
  Code,
  Word,
  Program
};
constexpr std::array kKindNames = {"comment", "keyword", "function", "operator", "variable", "parameter",
                                   "number",  "label",   "method",   "property", "namespace"};
constexpr std::array kModifierNames = {"readonly", "defaultLibrary"};
constexpr unsigned kReadOnly = 1;
constexpr unsigned kOfTheControl = 2;

class Writer {
public:
  explicit Writer(const View &view) : view_(view), file_(view.file()), places_(view.places()) {}

  std::vector<std::uint32_t> write() {
    const TokenBuffer tokens = lex(file_.source, view_.programs->dialect());
    for (std::size_t i = 0; i < tokens.size(); ++i)
      i += token(tokens, i);
    return std::move(data_);
  }

private:
  /// Writes the token at `i`; how many further ones it took.
  std::size_t token(const TokenBuffer &tokens, std::size_t i) {
    const Token &here = tokens[i];
    const Token *next = i + 1 < tokens.size() ? &tokens[i + 1] : nullptr;
    const bool isNumberNext = next && next->kind == TokenKind::Number;
    switch (here.kind) {
    case TokenKind::Comment: return comment(here.span());
    case TokenKind::ControlWord:
      put(here.span(), Kind::Keyword);
      if (here.controlWord() != ControlWord::Goto || !isNumberNext)
        return 0;
      put(next->span(), Kind::Label);
      return 1;
    case TokenKind::OWord: return put(here.span(), Kind::Keyword);
    case TokenKind::Function: return put(here.span(), Kind::Function);
    case TokenKind::Operator: return put(here.span(), Kind::Operator);
    case TokenKind::Number: return put(here.span(), Kind::Number);
    case TokenKind::Name: return put(here.span(), Kind::Program);
    case TokenKind::Hash: return isNumberNext ? variable(here, *next) : put(here.span(), Kind::Variable);
    case TokenKind::Address: return word(here, isNumberNext ? next : nullptr);
    case TokenKind::EndOfFile:
    case TokenKind::EndOfBlock:
    case TokenKind::OpenBracket:
    case TokenKind::CloseBracket:
    case TokenKind::Plus:
    case TokenKind::Minus:
    case TokenKind::Star:
    case TokenKind::Slash:
    case TokenKind::Equals:
    case TokenKind::Comma:
    case TokenKind::Colon:
    case TokenKind::Percent:
    case TokenKind::CloseParenthesis:
    case TokenKind::Less:
    case TokenKind::Greater:
    case TokenKind::Other: return 0;
    }
    return 0;
  }

  /// The clauses of a contract are left to the grammar of the editor, which colours their words.
  std::size_t comment(Span span) {
    const std::string_view text = trimmed(file_.source.text(span).substr(1));
    return text.starts_with('@') ? 0 : put(span, Kind::Comment);
  }
  std::size_t variable(const Token &hash, const Token &number) {
    const Span span = cover(hash.span(), number.span());
    const std::string_view digits = file_.source.text(number.span());
    std::uint32_t value = 0;
    const bool isWhole = std::from_chars(digits.data(), digits.data() + digits.size(), value).ec == std::errc();
    const VariableRange *range = isWhole ? findVariable(view_.programs->dialect(), value) : nullptr;
    const bool isOfControl = range && range->kind == VariableKind::System;
    const unsigned modifiers =
        (isOfControl ? kOfTheControl : 0) | (range && range->access == VariableAccess::ReadOnly ? kReadOnly : 0);
    put(span, range && range->kind == VariableKind::Local ? Kind::Parameter : Kind::Variable, modifiers);
    return 1;
  }
  std::size_t word(const Token &letter, const Token *number) {
    const Span span = number ? cover(letter.span(), number->span()) : letter.span();
    const std::size_t taken = number ? 1 : 0;
    switch (letter.letter()) {
    case 'G':
    case 'M': put(span, Kind::Code); return taken;
    case 'N': put(span, Kind::Label); return taken;
    case 'O': put(span, Kind::Program); return taken;
    default: return put(letter.span(), Kind::Word);
    }
  }

  std::size_t put(Span span, Kind kind, unsigned modifiers = 0) {
    const auto [line, from] = placeOf(span.begin);
    const auto [lastLine, to] = placeOf(span.end);
    if (lastLine != line) // clients take tokens of one line
      return 0;
    const std::uint32_t lines = line - line_;
    for (const std::uint32_t part : {lines, lines == 0 ? from - from_ : from, to - from,
                                     static_cast<std::uint32_t>(kind), static_cast<std::uint32_t>(modifiers)})
      data_.push_back(part);
    line_ = line;
    from_ = from;
    return 0;
  }

  /// Of offsets that come in order.
  Places::LineAndCharacter placeOf(std::uint32_t offset) {
    place_ = places_.lineAndCharacter(offset, offset_, place_);
    offset_ = offset;
    return place_;
  }

  const View &view_;
  const ProjectFile &file_;
  Places places_;
  std::uint32_t offset_ = 0; // the last one that was asked for
  Places::LineAndCharacter place_{0, 0};
  std::vector<std::uint32_t> data_;
  std::uint32_t line_ = 0;
  std::uint32_t from_ = 0;
};

} // namespace

Json semanticTokens(const View &view, const Json &) { return {{"data", Writer(view).write()}}; }

Json semanticTokensLegend() { return {{"tokenTypes", kKindNames}, {"tokenModifiers", kModifierNames}}; }

} // namespace feedhold::lsp
