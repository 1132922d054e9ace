// The words, variables and marks of a line, and what they say together.
#include "language/dialect/line_signals.h"

#include "language/dialect/comment_signals.h"
#include "language/dialect/line_scanner.h"

#include <array>
#include <optional>
#include <string_view>

namespace feedhold {

void LineScanner::scanToken() {
  const char c = peek();
  if (!isBlank(c) && c != '(' && c != ';')
    endsWithThen_ = false;
  if (isLetter(c)) {
    scanLetters();
    return;
  }
  switch (c) {
  case ' ':
  case '\t':
  case ']':
  case '+':
  case '-':
  case ',':
  case '/':
  case '%': ++at_; return;
  case '[': scanTemplateName(); return;
  case '@': scanAt(); return;
  case '*':
    ++at_;
    if (hasCode_ && trimmed(rest()).empty())
      count(TextSignal::HeidenhainIsoBlock);
    return;
  case '#': scanHash(); return;
  case '(': scanComment(); return;
  case ';':
    hasComment_ = true;
    stop();
    return;
  case '"': scanString(); return;
  case '<': scanAngle(); return;
  default: break;
  }
  if (isDigit(c) || c == '.')
    takeNumber();
  else
    scanMark(c);
}

/// Operators that Macro B does not have, and characters that no program has outside comments.
void LineScanner::scanMark(char c) {
  ++at_;
  const char next = peek();
  const bool isComparison = (c == '=' || c == '!' || c == '>') && next == '=';
  const bool isJunction = (c == '&' || c == '|') && next == c;
  const bool isAssignment = c == ':' && next == '=';
  const bool isAngle = c == '>' && hasHash_ && hasCondition_;
  if (isComparison || isJunction || isAssignment) {
    ++at_;
    if (isAssignment && hasHash_)
      count(TextSignal::ColonAssignment);
    else if (hasHash_)
      countCLike();
  } else if (isAngle) {
    countCLike();
  } else if (!scanHobbyMark(c) && static_cast<unsigned char>(c) >= 0x20 && c != '=') {
    hasUnknown_ = true; // blanks of other kinds and tape leader bytes are nothing
  }
}

/// `@100 = 25` and `Z@100`: LNC.  Macro B has no `@`.
void LineScanner::scanAt() {
  const bool isValue = at_ > 0 && isLetter(line_[at_ - 1]);
  ++at_;
  if (!isDigit(peek())) {
    hasUnknown_ = true;
    return;
  }
  takeNumber();
  skipBlanks();
  hasWord_ = true;
  if (isValue || (peek() == '=' && peek(1) != '='))
    count(TextSignal::LncVariable);
  else
    hasUnknown_ = true;
}

void LineScanner::scanLetters() {
  const std::size_t start = at_;
  const std::string_view run = takeRun();
  if (run.size() > 1) {
    scanLongRun(run);
    return;
  }
  at_ = start + 1;
  scanWord(toUpper(run[0]));
}

void LineScanner::scanLongRun(std::string_view run) {
  if (const Keyword *keyword = findKeyword(run)) {
    scanKeyword(*keyword);
    return;
  }
  if (scanPair(run))
    return;
  if (equalsUpper(run, "TC") && hasNumber('T') && isDigit(peek())) {
    count(TextSignal::TrainingTool);
    takeNumber();
    return;
  }
  if ((equalsUpper(run, "XH") || equalsUpper(run, "YH")) && isDigit(peek())) {
    count(TextSignal::ErosionValue);
    hasWord_ = true;
    takeNumber();
    return;
  }
  if (isSimulatorCall()) {
    count(TextSignal::SimulatorCall);
    stop();
    return;
  }
  if (equalsUpper(run, "DPRNT") || equalsUpper(run, "BPRNT")) {
    hasWord_ = true;
    stop(); // everything up to the bracket is text
    return;
  }
  scanJammed(run);
}

/// Keywords without blanks between them, with an address at the end: `THENGOTO`, `ANDG`.
void LineScanner::scanJammed(std::string_view run) {
  std::array<const Keyword *, 8> found{};
  std::size_t size = 0;
  std::string_view left = run;
  while (!left.empty() && size < found.size()) {
    const Keyword *keyword = longestKeywordPrefix(left);
    if (keyword == nullptr)
      break;
    found[size++] = keyword;
    left.remove_prefix(keyword->spelling.size());
  }
  const bool areAxes = left.find_first_not_of("XYZUVWABCxyzuvwabc") == std::string_view::npos;
  if (left.size() > 1 && !areAxes) {
    hasUnknown_ = true;
    return;
  }
  constexpr std::string_view kValue = "0123456789.#[=+-";
  const bool isProse = size == 1 && left.size() == 1 && kValue.find(peek()) == std::string_view::npos; // `cycles`
  if (isProse && found[0]->kind == KeywordKind::Signal) {
    hasUnknown_ = true;
    return;
  }
  for (std::size_t i = 0; i < size; ++i)
    scanKeyword(*found[i]);
  if (left.size() == 1 && isLetter(left[0]))
    scanWord(toUpper(left[0]));
}

/// Words that mean something only together with what follows.
bool LineScanner::scanPair(std::string_view run) {
  static constexpr std::string_view kFrames[] = {"BEGIN PGM", "END PGM",  "BLK FORM",
                                                 "TOOL CALL", "TOOL DEF", "CALL PGM"};
  const std::size_t start = static_cast<std::size_t>(run.data() - line_.data());
  for (const std::string_view frame : kFrames) {
    if (beginsUpper(line_.substr(start), frame)) {
      count(TextSignal::KlartextFrame);
      at_ = start + frame.size();
      return true;
    }
  }
  const std::size_t after = at_;
  skipBlanks();
  const std::optional<TextSignal> signal =
      pairSignal(run, start == 0, isDigit(after < line_.size() ? line_[after] : 0));
  if (!signal) {
    at_ = after;
    return false;
  }
  count(*signal);
  stop();
  return true;
}

/// `G85 NLAP1`, `NLAP1 G81`.
bool LineScanner::hasLapCode() const {
  if (hasAnyCode(81, 88))
    return true;
  const std::string_view behind =
      trimmed(rest().substr(std::min(rest().find_first_not_of("0123456789"), rest().size())));
  return behind.size() >= 3 && beginsUpper(behind, "G8") && behind[2] >= '1' && behind[2] <= '8' &&
         (behind.size() == 3 || !isDigit(behind[3]));
}

/// `run` is in front of at_, where blanks have been skipped; `isJoined`: a digit directly follows it.
std::optional<TextSignal> LineScanner::pairSignal(std::string_view run, bool isFirst, bool isJoined) const {
  static constexpr std::string_view kTypes[] = {"REAL", "INT", "BOOL", "STRING", "CHAR", "AXIS", "FRAME"};
  static constexpr std::string_view kCoordinates[] = {"AC", "IC", "DC", "ACP", "ACN"};
  static constexpr std::string_view kTextParameters[] = {"QL", "QR", "QS"};
  const std::string_view next = peekRun();
  const bool isDefinition = equalsUpper(run, "DEF") && isOneOf(next, kTypes);
  if (isDefinition || ((run == "PROC" || run == "EXTERN") && isFirst && next.size() > 2))
    return TextSignal::SinumerikDefinition;
  const bool isMessage = equalsUpper(run, "MSG") && peek() == '(' && peek(1) == '"';
  if (isMessage || (isOneOf(run, kCoordinates) && peek() == '('))
    return TextSignal::SinumerikWord;
  const bool isCall = equalsUpper(run, "CALL");
  if (isCall && next.size() > 1 && toUpper(next[0]) == 'O')
    return TextSignal::OkumaControl;
  if ((isCall && equalsUpper(next, "LBL")) || (equalsUpper(run, "FN") && isDigit(peek())))
    return TextSignal::KlartextLabel;
  if (equalsUpper(run, "SUB") && isFirst && next.size() > 1)
    return TextSignal::EdingStatement;
  const bool isSystemVariable = run.size() >= 4 && toUpper(run[0]) == 'V' && peek() == '[';
  if (isSystemVariable || (equalsUpper(run, "VC") && isDigit(peek())))
    return TextSignal::OkumaVariable;
  if (run.size() >= 2 && toUpper(run[0]) == 'N' && isJoined && (isFirst || run.size() >= 3)) {
    if (run.size() >= 3 && hasLapCode())
      return TextSignal::OkumaLap;
    if (isFirst)
      return TextSignal::OkumaLabel;
  }
  if (equalsUpper(run, "AR") && peek() == '[')
    return TextSignal::HuazhongFunction;
  if (isOneOf(run, kTextParameters) && isDigit(peek()))
    return TextSignal::KlartextParameter;
  return std::nullopt;
}

void LineScanner::scanKeyword(const Keyword &keyword) {
  hasWord_ = true;
  if (keyword.kind == KeywordKind::Signal)
    count(keyword.signal);
  if (keyword.spelling == "IF" || keyword.spelling == "WHILE") {
    hasIf_ = hasIf_ || keyword.spelling == "IF";
    hasCondition_ = true;
    scanCondition();
  } else if (keyword.spelling == "THEN") {
    endsWithThen_ = true;
    noteBranch();
  } else if (keyword.spelling == "GOTO") {
    noteBranch();
  } else if (keyword.spelling == "DO" && !hasOWord_) {
    skipBlanks();
    if (isDigit(peek()))
      count(TextSignal::NumberedLoop);
    hasBareDo_ = atEnd() || peek() == ';' || peek() == '(';
  } else if (keyword.spelling == "ENDIF" && !hasOWord_) {
    count(TextSignal::BlockIf);
  }
}

void LineScanner::scanCondition() {
  skipBlanks();
  if (peek() == '#')
    count(TextSignal::BareCondition);
}

void LineScanner::scanWord(char letter) {
  if (letter == 'O') { // `N10 o100 call`
    --at_;
    if (scanOWord())
      return;
    ++at_;
  }
  if (letter == 'V' && peek() == '.' && isLetter(peek(1)) && peek(2) == '.') {
    count(TextSignal::IsgVariable);
    stop();
    return;
  }
  const std::size_t after = at_;
  skipBlanks();
  while (peek() == '-' || peek() == '+' || isBlank(peek()))
    ++at_;
  const char next = peek();
  letters_ |= 1U << (letter - 'A');
  hasNegativeP_ = hasNegativeP_ || (letter == 'P' && isDigit(next) && line_[at_ - 1] == '-');
  if (isDigit(next) || next == '.') {
    hasWord_ = true;
    numbered_ |= 1U << (letter - 'A');
    scanNumberedWord(letter, takeNumber());
  } else if (next == '#' || next == '[') {
    hasWord_ = true;
    hasVariableP_ = hasVariableP_ || (letter == 'P' && next == '#');
  } else if (next == '=') {
    scanEquals(letter);
  } else {
    at_ = after;
  }
}

/// `X=R1`: only languages with names put an equals sign after an address.
void LineScanner::scanEquals(char letter) {
  constexpr std::string_view kAddresses = "XYZABCUVWIJKFSTDH";
  if (kAddresses.find(letter) == std::string_view::npos || peek(1) == '=')
    return;
  count(TextSignal::SinumerikWord);
  ++at_;
}

/// `T0303`, the turret and its offset: no mill numbers its tools so.
bool isPair(std::uint32_t tool) { return tool / 100 == tool % 100; }

void LineScanner::scanNumberedWord(char letter, const Number &number) {
  const std::size_t after = at_;
  skipBlanks();
  if (peek() == '=' && peek(1) != '=') {
    if (letter == 'R')
      count(TextSignal::SinumerikVariable);
    else if (letter == 'V')
      count(TextSignal::OkumaVariable);
    else if (scanErosion(letter, number))
      return;
    else if (letter == 'Q')
      count(TextSignal::KlartextParameter);
    else if (letter == 'L' || letter == 'E')
      count(TextSignal::LetterVariable);
  }
  at_ = after;
  switch (letter) {
  case 'G':
    hasCode_ = true;
    ++codes_;
    scanGCode(number);
    return;
  case 'M':
    hasCode_ = true;
    scanMCode(number);
    return;
  case 'O':
    count(TextSignal::ProgramNumber);
    if (number.digits == 5 && number.whole < 10000)
      count(TextSignal::HaasProgramNumber);
    else if (number.digits == 8 && number.whole / 1000 == 10000)
      count(TextSignal::DdcsTitle);
    return;
  case 'D': // `D00 Q1 P01 +5 *`: a function with parameters
    hasDecimalD_ = hasDecimalD_ || number.hasFraction;
    if (!hasCode_ && number.digits == 2 && peek() == ' ' && (peek(1) == 'Q' || peek(1) == 'q'))
      count(TextSignal::HeidenhainIsoBlock);
    return;
  case 'P': contourFirst_ = number.whole; return;
  case 'Q': contourLast_ = number.whole; return;
  case 'E': hasOffsetE_ = !number.hasFraction && number.digits <= 2 && line_[after - 1] != '.'; return;
  case 'L': hasSubprogramL_ = !number.hasFraction && number.digits >= 3 && line_[after - 1] != '.'; return;
  case 'T':
    if (number.digits == 4 || (number.digits == 3 && number.whole / 100 == number.whole % 100))
      for (int times = number.digits == 4 && isPair(number.whole) ? 3 : 1; times > 0; --times)
        count(TextSignal::TurretTool);
    else if (number.hasFraction && !hasG65_)
      count(TextSignal::FagorTool);
    else
      scanErosionTool(number);
    return;
  default: return;
  }
}

void LineScanner::scanGCode(const Number &number) {
  if (number.hasFraction) { // synchronized spindle and probing codes of RS274NGC
    if ((number.whole == 33 && number.tenths == '1') ||
        (number.whole == 38 && number.tenths >= '2' && number.tenths <= '5'))
      count(TextSignal::NgcCode);
    hasProbing_ = hasProbing_ || number.whole == 38;
    return;
  }
  if (number.whole < gCodes_.size())
    gCodes_.set(number.whole);
  switch (number.whole) {
  case 4: hasG4_ = true; return;
  case 15: hasG15_ = true; return;
  case 28:
  case 30:
  case 53: hasHome_ = true; return;
  case 31: hasG31_ = true; return;
  case 43: count(TextSignal::LengthOffset); return;
  case 50: hasG50_ = true; return;
  case 92: hasG92_ = hasHome_ = true; return;
  case 64: hasG64_ = true; return;
  case 65: hasG65_ = true; return;
  case 70:
  case 71:
  case 72:
  case 73:
  case 76: hasTurningCycle_ = true; return;
  case 90: hasG90_ = true; return;
  case 91: hasG91_ = true; return;
  case 96: hasG96_ = true; return;
  case 103:
  case 136:
  case 143:
  case 153:
  case 154:
  case 187: count(TextSignal::HaasCode); return;
  default: return;
  }
}

namespace {

/// `-5000(text`: the number of a message and, at once, its text.
bool isNumberBeforeText(std::string_view value) {
  value = trimmed(value);
  if (!value.empty() && value.front() == '-')
    value.remove_prefix(1);
  const std::size_t end = value.find_first_not_of("0123456789");
  return end != 0 && end != std::string_view::npos && value[end] == '(';
}

} // namespace

void LineScanner::scanHash() {
  const bool isBracketed = at_ > 0 && line_[at_ - 1] == '[';
  ++at_;
  skipBlanks();
  const char next = peek();
  hasHash_ = hasHash_ || isDigit(next) || next == '[' || next == '<';
  if (isDigit(next)) {
    hasWord_ = true;
    scanVariable(takeNumber());
  } else if (next == '<') {
    count(TextSignal::AngleName);
    hasWord_ = true;
    const std::size_t end = line_.find('>', at_);
    const std::string_view name = line_.substr(at_, end == std::string_view::npos ? end : end - at_);
    if (name.find('|') != name.npos || beginsUpper(name, "<_MOTORLIMIT_") || beginsUpper(name, "<_HOMESWITCH_"))
      count(TextSignal::PlanetMark);
    else if (peek(1) == '/') // `#</atc/tool>`: a setting of FluidNC by its path
      count(TextSignal::GrblCommand);
    at_ = end == std::string_view::npos ? line_.size() : end + 1;
  } else if (next == '[' || next == '#') {
    hasWord_ = true;
    if (beginsUpper(rest(), "[805+") && rest().find("#578") != std::string_view::npos)
      count(TextSignal::DdcsOffset);
  } else if (next == '_' && isBracketed) {
    count(TextSignal::FanucNamedVariable);
    hasWord_ = true;
    takeRun();
  } else if (isBracketed && isLetter(next)) {
    takeRun();
  } else {
    hasUnknown_ = true;
  }
}

void LineScanner::scanVariable(const Number &number) {
  count(TextSignal::HashVariable);
  const std::uint32_t n = number.whole;
  if ((n >= 400 && n <= 499) || (n >= 900000 && n <= 907399))
    count(TextSignal::MitsubishiVariable);
  else if (n == 4014 || n == 4214)
    count(TextSignal::FanucOffsetGroup);
  else if (n == 4012 || n == 4212)
    count(TextSignal::MitsubishiOffsetGroup);
  else if (n >= 10000 && n <= 10999)
    count(TextSignal::HaasVariable);
  else if (n >= 3020 && n <= 3033)
    count(TextSignal::HaasTimer);
  else if ((n >= 20000 && n <= 20999) || (n >= 30000 && n <= 39999))
    count(TextSignal::HaasSetting);
  else if (n >= 16001 && n <= 17999)
    count(TextSignal::MitsubishiToolOffset);
  else if (n >= 100000 && n <= 100010)
    count(TextSignal::MitsubishiParameterRead);
  else if (n >= 98000 && n <= 199999)
    count(TextSignal::FanucLargeVariable);
  if (n >= 1920 && n <= 1929)
    count(TextSignal::DdcsVariable);
  else if ((n >= 790 && n <= 794) || (n >= 880 && n <= 884))
    count(TextSignal::DdcsPosition);
  skipBlanks();
  if (peek() != '=' || peek(1) == '=')
    return;
  if (n == 3000)
    count(TextSignal::MacroAlarm);
  else if ((n == 1503 || n == 1505 || n == 2070) && isNumberBeforeText(rest().substr(1)))
    count(TextSignal::DdcsMessage);
  else if (n >= 1500 && n <= 1519) // no Macro B control has variables there
    count(TextSignal::DdcsVariable);
}

void LineScanner::scanComment() {
  hasComment_ = true;
  const std::size_t length = commentLength(rest());
  const bool isAlone = !hasHash_ && (letters_ & ~(1U << ('N' - 'A'))) == 0;
  const CommentPlace place = isAlone ? CommentPlace::Alone : CommentPlace::BesideCode;
  if (feedhold::scanComment(rest().substr(0, length), place, scan_) == CommentLanguage::Foreign)
    hasSignal_ = true;
  at_ += length;
}

void LineScanner::scanAngle() {
  const std::size_t end = line_.find('>', at_);
  const std::string_view name = end == std::string_view::npos ? "" : line_.substr(at_ + 1, end - at_ - 1);
  constexpr std::string_view kNameCharacters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+-_.";
  const bool isName = !name.empty() && name.size() <= 32 && isLetter(name[0]) &&
                      name.find_first_not_of(kNameCharacters) == std::string_view::npos;
  if (!isName) {
    if (hasHash_ && hasCondition_)
      countCLike();
    else
      hasUnknown_ = true;
    ++at_;
    return;
  }
  hasWord_ = true;
  at_ = end + 1;
  skipBlanks();
  count(peek() == '=' ? TextSignal::CentroidStatement : TextSignal::FanucProgramName); // `<SPEED> = #S`
}

/// `IF [#1 GT 2]` and nothing behind it.
bool LineScanner::isBareIf() const {
  if (!hasIf_ || hasOWord_ || !beginsUpper(trimmed(line_), "IF"))
    return false;
  const std::string_view code = trimmed(line_.substr(0, line_.find_first_of("(;")));
  return code.ends_with(']') && code.find('=') == std::string_view::npos && letters_ == 0;
}

void LineScanner::countCombinations() {
  if (hasIf_ && endsWithThen_ && !hasOWord_)
    count(TextSignal::BlockIf);
  if (isBareIf())
    note(TextSignal::HuazhongIf);
  if (hasG65_ && hasLetter('P'))
    count(TextSignal::MacroCall);
  noteContour();
  if (hasProbing_ && hasNumber('P'))
    count(TextSignal::PrinterProbe);
  if (hasM98_ && hasLetter('P'))
    count(TextSignal::SubprogramCall);
  if (hasG65_ && hasLetter('H') && hasVariableP_) // `P#100` is where the result goes; of a call it is the program
    count(TextSignal::MacroA);
  if (hasG15_ && hasLetter('H'))
    count(TextSignal::OkumaWorkOffset);
  if ((hasG4_ && hasNegativeP_) || (hasG31_ && hasLetter('L') && hasLetter('Q')))
    count(TextSignal::DdcsWord);
  if ((hasM82_ && hasM84_) || erosionTools_ == 2)
    count(TextSignal::ErosionSwitch);
  if (hasM97_ && hasLetter('P'))
    count(TextSignal::HaasLocalCall);
  if (hasRelay_ && hasLetter('P')) // `M59 P2`: an output is switched
    count(TextSignal::HaasCode);
  if ((hasG50_ || hasG92_) && hasLetter('S') && !hasLetter('X') && !hasLetter('Z'))
    count(TextSignal::SpindleLimit);
  if (hasG96_)
    count(TextSignal::SurfaceSpeed);
  if (isTurningCycle())
    count(TextSignal::TurningCycle);
  // `G71 P10 Q20 U.02 W.005 D.05`, the cycle in one block; `G12 I.5 K1. Q.2`, a pocket in several turns.
  if ((hasTurningCycle_ && hasDecimalD_ && hasLetter('P') && hasLetter('Q')) ||
      ((gCodes_[12] || gCodes_[13]) && hasLetter('I') && hasLetter('K') && hasLetter('Q')) || isEngraving())
    count(TextSignal::HaasCode);
  if (isNgcLine())
    count(TextSignal::NgcCode);
  if (hasBareDo_ && hasCLike_)
    count(TextSignal::BeagleLoop);
  countFadalMarks();
  if (!hasG65_) { // whose letters are arguments
    countLatheMarks();
    countGCodeSystem();
  }
}

void LineScanner::sortLine() {
  scan_.codeLines += hasCode_ ? 1U : 0U;
  if (!hasUnknown_ && (hasWord_ || hasSignal_))
    ++scan_.programLines;
  else if (hasSignal_)
    ++scan_.signalLines;
  else if (hasUnknown_ || !hasComment_)
    ++scan_.otherLines;
}

void scanLine(std::string_view line, TextScan &scan) { LineScanner(line, scan).run(); }

} // namespace feedhold
