// A letter typed where a digit is meant: `GOO` for `G00`, `X1O.` for `X10.`, `Yl.` for `Y1.`
#pragma once

#include "findings/rule/rule.h"

#include <optional>
#include <string>

namespace feedhold::rules {

/// A piece of a block without a blank in it, and what it holds when letters are taken for the digits they look like.
struct MistypedDigits {
  Span span;
  std::string meant;
  bool hasO = false;
  bool hasI = false;   // I or l
  bool isJump = false; // the other way round: `GOT0300`
};

/// Around the place at which a block could not be read.  Absent where the letters are none that look like digits, or
/// where what comes out is no row of words.
std::optional<MistypedDigits> mistypedDigitsAt(std::uint32_t place, const FileContext &context);

/// "the letter `O` stands in the place of the digit 0"
std::string describe(const MistypedDigits &digits);
std::vector<FixIt> fixesFor(const MistypedDigits &digits);

} // namespace feedhold::rules
