#include "rules/words/letter_for_digit.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <utility>

namespace feedhold::rules {
namespace {

constexpr std::uint32_t kLongest = 40;

bool isOfPiece(char c) { return isLetter(c) || isDigit(c) || c == '.' || c == '-' || c == '+'; }

Span pieceAround(std::uint32_t place, std::string_view text) {
  std::uint32_t begin = place;
  std::uint32_t end = place;
  while (begin > 0 && place - begin < kLongest && isOfPiece(text[begin - 1]))
    --begin;
  while (end < text.size() && end - place < kLongest && isOfPiece(text[end]))
    ++end;
  return {begin, end};
}

/// Reads a piece as words, each an address and a number.
class Reader {
public:
  /// `goesOn`: behind the piece stands the value of its last word, `GOIX#1`.
  bool read(std::string_view piece, bool goesOn) {
    for (const char c : piece)
      if (!take(c))
        return false;
    const bool isOpen = goesOn && !hasDigit_ && !hasPoint_;
    return (hasO || hasI) && (isOpen || isNumber() || piece.size() == 2);
  }
  std::string meant;
  bool hasO = false;
  bool hasI = false;

private:
  bool take(char c) {
    if (meant.empty() || (isLetter(c) && !digitLike(c))) {
      // No address without a number, and no word of letters.
      if (!isLetter(c) || (!meant.empty() && !isNumber()))
        return false;
      meant += c;
      address_ = toUpper(c);
      hasDigit_ = isGuessed_ = hasPoint_ = isSure_ = false;
      return true;
    }
    return takeOfNumber(c);
  }
  /// More than letters, but for a code: `TOOL1` is a word of a language.
  bool isNumber() const { return hasDigit_ && (isSure_ || hasPoint_ || address_ == 'G' || address_ == 'M'); }
  /// `I` behind a digit begins the word of a centre.
  bool digitLike(char c) const { return c == 'O' || c == 'o' || c == 'l' || (c == 'I' && (!hasDigit_ || isGuessed_)); }
  bool takeOfNumber(char c) {
    if (c == '-' || c == '+') {
      meant += c;
      return !hasDigit_ && !hasPoint_ && isLetter(meant[meant.size() - 2]);
    }
    if (c == '.') {
      meant += c;
      return !std::exchange(hasPoint_, true);
    }
    if (isLetter(c)) {
      (toUpper(c) == 'O' ? hasO : hasI) = true;
      c = toUpper(c) == 'O' ? '0' : '1';
      isGuessed_ = true;
    } else {
      isSure_ = true;
      isGuessed_ = false;
    }
    hasDigit_ = true;
    meant += c;
    return true;
  }

  char address_ = 0;
  bool isSure_ = false;    // a digit as such
  bool hasDigit_ = false;  // in the number so far
  bool isGuessed_ = false; // its last one was a letter
  bool hasPoint_ = false;
};

} // namespace

std::optional<MistypedDigits> mistypedDigitsAt(std::uint32_t place, const FileContext &context) {
  const Span span = pieceAround(place, context.source.text());
  const std::string_view piece = context.text(span);
  const std::string_view behind = context.source.text().substr(span.end, 1);
  if (piece.starts_with("GOT0"))
    return MistypedDigits{.span = span, .meant = fmt::format("GOTO{}", piece.substr(4)), .isJump = true};
  Reader reader;
  if (span.size() > kLongest || piece.starts_with("GOT") || !reader.read(piece, behind == "#" || behind == "["))
    return std::nullopt;
  return MistypedDigits{span, std::move(reader.meant), reader.hasO, reader.hasI};
}

std::string describe(const MistypedDigits &digits) {
  if (digits.isJump)
    return "`GOTO` is written with the digit 0";
  if (digits.hasO && digits.hasI)
    return "letters stand in the place of the digits 0 and 1";
  return digits.hasO ? "the letter `O` stands in the place of the digit 0"
                     : "the letter `I` or `l` stands in the place of the digit 1";
}

std::vector<FixIt> fixesFor(const MistypedDigits &digits) {
  return {{.title = fmt::format("write `{}`", digits.meant), .edits = {{digits.span, digits.meant}}}};
}

} // namespace feedhold::rules
