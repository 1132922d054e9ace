// Printers, hobby controls and small controls: codes of their own, messages, heaters, texts in quotes, and names that
// the control or a slicer replaces.
#include "language/dialect/line_scanner.h"

#include <algorithm>

namespace feedhold {

/// `M118 Probing`, `M104 S200`: messages and heaters of hobby controls and printers.
void LineScanner::scanPrinterCommand() {
  static constexpr std::string_view kMessages[] = {"M117 ", "M118 "};
  static constexpr std::string_view kHeaters[] = {"M104 S", "M109 S", "M140 S", "M190 S"};
  const auto begins = [&](std::string_view command) { return beginsUpper(rest(), command); };
  if (std::ranges::any_of(kMessages, begins) && isLetter(peek(5)) && isLetter(peek(6))) {
    count(TextSignal::PrinterMessage);
    hasWord_ = true;
    stop();
  } else if (std::ranges::any_of(kHeaters, begins) && isDigit(peek(6))) {
    count(TextSignal::PrinterHeater);
  }
}

/// Tool changes and calls, and what only some controls have: `M225 #140`, `M200 "PRESS START"`, `M95 /37`.
void LineScanner::scanMCode(const Number &number) {
  switch (number.whole) {
  case 6: count(TextSignal::ToolChange); return;
  case 59:
  case 69: hasRelay_ = true; return;
  case 82: hasM82_ = true; return;
  case 84: hasM84_ = true; return;
  case 97: hasM97_ = true; return;
  case 98: hasM98_ = true; return;
  case 94:
  case 95:
  case 109: // `M95 /37`: an output is switched off
    skipBlanks();
    if (peek() == '/' && isDigit(peek(1)))
      count(TextSignal::CentroidStatement);
    return;
  case 200:
  case 225:
    skipBlanks();
    if (peek() == '#' || peek() == '"')
      count(TextSignal::CentroidStatement);
    return;
  default: return;
  }
}

/// `F$110`, a setting of GRBL as a value; `F{speed}`, an expression or a name in braces, `X{param.R}`.  `${..}` and
/// `{{..}}` are for programs that make programs.
bool LineScanner::scanHobbyMark(char mark) {
  const char before = at_ > 1 ? line_[at_ - 2] : '\0';
  if (mark == '$' && isLetter(before) && isDigit(peek())) {
    count(TextSignal::GrblCommand);
    takeNumber();
    return true;
  }
  if (mark != '{' || before == '$' || !(isLetter(peek()) || peek() == '"'))
    return false;
  static constexpr std::string_view kObjects[] = {"PARAM.", "GLOBAL.", "VAR.", "MOVE.", "STATE.", "SENSORS."};
  const bool isOfObject =
      std::ranges::any_of(kObjects, [&](std::string_view object) { return beginsUpper(rest(), object); });
  count(isOfObject ? TextSignal::PrinterObject : TextSignal::TemplateName);
  stop();
  return true;
}

/// `S[first_layer_temperature]`: macros have variables with `#`, or functions, in the brackets of a word.
void LineScanner::scanTemplateName() {
  const bool isWord = at_ > 0 && isLetter(line_[at_ - 1]) && (at_ == 1 || !isLetter(line_[at_ - 2]));
  const std::size_t end = line_.find(']', at_);
  const std::string_view name = line_.substr(at_ + 1, end == std::string_view::npos ? 0 : end - at_ - 1);
  if (isWord && name.size() > 2 && isLetter(name[0]) && name.find('_') != std::string_view::npos &&
      std::ranges::all_of(name, [](char c) { return isNameCharacter(c); })) {
    count(TextSignal::TemplateName);
    at_ = end;
  }
  ++at_;
}

/// `M98 P"file.g"`, where the letter stands at the quotation mark, or a subprogram by the name of its file.
void LineScanner::scanString() {
  const std::size_t end = line_.find('"', at_ + 1);
  const bool isValue = at_ > 0 && isLetter(line_[at_ - 1]) && end != std::string_view::npos;
  hasWord_ = hasWord_ || isValue;
  if (isValue)
    count(TextSignal::PrinterText);
  else if (hasG65_ || hasM98_)
    count(TextSignal::CentroidStatement);
  else
    hasUnknown_ = true;
  at_ = end == std::string_view::npos ? line_.size() : end + 1;
}

/// `G64 P0.01`, `G96 D2500 S150`, and `G7` where no word beside it makes it another function.
bool LineScanner::isNgcLine() const {
  const bool isDiameterMode = gCodes_[7] && (letters_ & ~lettersOf("GNMFST")) == 0;
  return (hasG64_ && hasNumber('P')) || (hasG96_ && hasLetter('D') && hasLetter('S')) || isDiameterMode;
}

/// `G47 P0 (TEXT) X2. Y2. I45. J.5 R.05 Z-.005 F15. E10.`
bool LineScanner::isEngraving() const {
  return gCodes_[47] && hasNumber('P') && hasLetter('J') && hasLetter('Z') && !hasLetter('D');
}

} // namespace feedhold
