// dump: tokens as text, one a line: kind, bytes, text.
#include "language/lex/lexer.h"

#include <fmt/format.h>

namespace feedhold {

namespace {

/// Control bytes as `\x0a`, so that a token stays on its line.
std::string visible(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    result += byte < ' ' ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
  }
  return result;
}

} // namespace

std::string dump(const TokenBuffer &tokens, const SourceFile &source) {
  std::string text;
  for (const Token &token : tokens)
    text += fmt::format("{:<13} {:<7} {}{}\n", nameOf(token.kind), fmt::format("{}-{}", token.begin, token.end),
                        visible(source.utf8(token.span())), token.abbreviated ? " (abbreviated)" : "");
  return text;
}

} // namespace feedhold
