// Lexer: text -> tokens.  Never fails: a byte that fits nowhere becomes an `Other` token.
#pragma once

#include "base/source/source_file.h"
#include "language/dialect/dialect.h"
#include "language/lex/token.h"

#include <optional>
#include <string>
#include <string_view>

namespace feedhold {

/// Blanks between tokens: space, tab, and control bytes other than line ends (tape leaders are made of NUL).
bool isTrivia(char c);

/// The value of a Number token, read while its end was looked for: a CAM program is mostly numbers.
struct NumberText {
  std::int64_t mantissa = 0; // of the first kMostDigits digits
  std::uint32_t digits = 0;  // without leading zeros
  std::uint32_t decimals = 0;
  std::uint32_t points = 0;

  /// Digits that 64 bits hold; no control takes as many.
  static constexpr std::uint32_t kMostDigits = 18;
};

/// Hands out one token after another.  The parser pulls, so that a program of a million blocks needs no buffer.
/// Cheap to copy: a copy is a place to come back to.
class Lexer {
public:
  /// The grammar is the dialect's and outlives the lexer.
  Lexer(std::string_view text, const Grammar &grammar);

  Token next();
  /// Of the token that next() gave last, when that is a Number.
  const NumberText &lastNumber() const { return number_; }
  /// Goes on reading at `offset`: behind raw text (DPRNT formats, leaders) or back at a saved place.
  void moveTo(std::uint32_t offset) { at_ = offset; }
  /// End of the line that holds `offset`, without its line end.
  std::uint32_t lineEnd(std::uint32_t offset) const;
  /// The `]` that belongs to the `[` at `open`, on the same line and with nothing read as tokens between; absent when
  /// there is none.
  std::optional<std::uint32_t> closingBracket(std::uint32_t open) const;

private:
  Token letters(std::uint32_t begin);
  Token oWord(std::uint32_t begin);
  Token number(std::uint32_t begin);
  Token comment(std::uint32_t begin);
  std::optional<std::uint32_t> endOfParagraph(std::uint32_t from) const;
  Token star(std::uint32_t begin);
  Token endOfBlock(std::uint32_t begin);
  bool followsProgramNumber(std::uint32_t offset) const;
  Token angle(std::uint32_t begin);
  Token other(std::uint32_t begin);
  Token make(TokenKind kind, std::uint32_t begin, std::uint32_t end);
  char at(std::uint32_t offset) const { return offset < text_.size() ? text_[offset] : '\0'; }
  std::uint32_t afterBlanks(std::uint32_t offset) const;
  std::uint32_t afterLetters(std::uint32_t offset, std::uint32_t limit) const;
  std::uint32_t afterLineEnd(std::uint32_t offset) const;
  std::uint32_t size() const { return static_cast<std::uint32_t>(text_.size()); }

  std::string_view text_;
  const Grammar *grammar_;
  std::uint32_t at_ = 0;
  NumberText number_;
};

/// All tokens of a file, the last one EndOfFile.
TokenBuffer lex(const SourceFile &file, const Dialect &dialect);

/// The tokens as text, one a line: what golden cases compare.
std::string dump(const TokenBuffer &tokens, const SourceFile &source);

} // namespace feedhold
