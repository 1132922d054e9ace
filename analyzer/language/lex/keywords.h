// The words of letters that the macro language knows, their aliases, and their two-letter short forms.
#pragma once

#include "language/lex/token.h"

#include <optional>
#include <string_view>

namespace feedhold {

struct KeywordMatch {
  TokenKind kind = TokenKind::Other; // Function, Operator or ControlWord; Other: no keyword here
  std::uint8_t detail = 0;
  std::uint8_t length = 0;
  bool abbreviated = false;
};

/// The longest keyword at the start of `run` (a run of letters in any case); `next` is the first byte after the run
/// that is not blank (0 at the end).  A short form needs to be the whole run and to stand before something that its
/// long form could stand before: two letters are too little evidence elsewhere.
KeywordMatch matchKeyword(std::string_view run, char next);

/// `sub`, `endif`: the o-word that the whole run is.
std::optional<OWordKind> findOWord(std::string_view run);

} // namespace feedhold
