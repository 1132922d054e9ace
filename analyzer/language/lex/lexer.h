// Lexer: text -> tokens.  Never fails: a byte that fits nowhere becomes an `Other` token.
#pragma once

#include "base/source/source_file.h"
#include "language/lex/token.h"

#include <string_view>

namespace feedhold {

/// Hands out one token after another.  The parser pulls, so that a program of a million blocks needs no buffer.
class Lexer {
public:
  explicit Lexer(std::string_view text, std::uint32_t from = 0);

  Token next();
  /// The rest of the line from `from` on as raw text (DPRNT formats, leaders); the lexer goes on after it.
  void skipTo(std::uint32_t offset) { at_ = offset; }

private:
  Token letters(std::uint32_t begin);
  Token number(std::uint32_t begin);
  Token comment(std::uint32_t begin);
  Token lineEnd(std::uint32_t begin);
  Token name(std::uint32_t begin);
  Token symbol(std::uint32_t begin);
  Token other(std::uint32_t begin);

  std::string_view text_;
  std::uint32_t at_;
};

/// All tokens of a file, the last one EndOfFile.
TokenBuffer lex(const SourceFile &file);

} // namespace feedhold
