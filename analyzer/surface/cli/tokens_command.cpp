// `feedhold tokens FILE`: what the lexer sees, a token a line: kind, bytes, text.
#include "language/lex/lexer.h"
#include "surface/cli/dump_input.h"

#include <fmt/format.h>

namespace feedhold {

namespace {

std::string visible(std::string text) {
  std::string result;
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < ' ')
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    else
      result += c;
  }
  return result;
}

std::string dumpTokens(const SourceFile &source, const Dialect &) {
  std::string text;
  for (const Token &token : lex(source))
    text += fmt::format("{:<18} {}-{} {}\n", nameOf(token.kind), token.begin, token.end,
                        visible(source.utf8(token.span())));
  return text;
}

} // namespace

Command addTokensCommand(CLI::App &parent) {
  return addDumpCommand(parent, "tokens", "print the tokens of a program", dumpTokens);
}

} // namespace feedhold
