// Token: a piece of program text with a kind; what lies between two tokens is blanks.
#pragma once

#include "base/source/span.h"
#include "language/dialect/words.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace feedhold {

enum class TokenKind : std::uint8_t {
#define TOKEN(kind, name) kind,
#include "language/lex/tokens.def"
};

std::string_view nameOf(TokenKind kind);

struct Token {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  TokenKind kind = TokenKind::EndOfFile;
  /// Address: the letter in upper case.  Function, Operator, ControlWord, OWord: the value of
  /// that enum.
  std::uint8_t detail = 0;
  /// Function, Operator, ControlWord: written in its short form (`WH`, `RO`).
  bool abbreviated = false;

  Span span() const { return {begin, end}; }
  char letter() const { return static_cast<char>(detail); }
  FunctionKind function() const { return static_cast<FunctionKind>(detail); }
  OperatorKind op() const { return static_cast<OperatorKind>(detail); }
  ControlWord controlWord() const { return static_cast<ControlWord>(detail); }
  OWordKind oWord() const { return static_cast<OWordKind>(detail); }
};

using TokenBuffer = std::vector<Token>;

} // namespace feedhold
