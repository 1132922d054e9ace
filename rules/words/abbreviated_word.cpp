// abbreviated-word: `WH`, `GO`, `RO`.
#include "findings/rule/rule.h"

#include "language/lex/lexer.h"
#include "rules/structure/structure_view.h"

#include <fmt/format.h>

namespace feedhold::rules::abbreviated_word {
namespace {

/// Read in its place: what follows a short form decides whether it is one.
std::string_view longForm(const FileContext &context, Span span) {
  Lexer lexer(context.source.text(), context.dialect.grammar);
  lexer.moveTo(span.begin);
  const Token token = lexer.next();
  if (token.kind == TokenKind::ControlWord)
    return spellingOf(token.controlWord());
  return token.kind == TokenKind::Function ? spellingOf(token.function()) : spellingOf(token.op());
}

void check(const FileContext &context, const Reporter &reporter) {
  for (const Span span : context.tree.abbreviations) {
    // `GO1 X5.` with the letter for the digit: macro-statement-with-words speaks of it.
    if (isMotionCodeWithLetter(context, context.tree.blockAt(span.begin), {span.begin, span.end + 1}))
      continue;
    const std::string_view meant = longForm(context, span);
    reporter.report({.message = fmt::format("{} is short for `{}`", context.quoted(span), meant),
                     .span = span,
                     .notes = {"other controls, and other people, may not know the short form"},
                     .fixes = {{FixSafety::Safe, fmt::format("write `{}`", meant), {{span, std::string(meant)}}}}});
  }
}

} // namespace

extern const Rule abbreviatedWord;
const Rule abbreviatedWord{.info = {"abbreviated-word", Category::Word, Severity::Info,
                                    "Reports a macro keyword in its short form, such as `WH` for `WHILE`."},
                           .hooks = {.file = check}};

} // namespace feedhold::rules::abbreviated_word
