// How lines begin: block skip, program numbers, and the marks of languages that are not Macro B.
#include "language/dialect/line_scanner.h"
#include "language/dialect/remarks.h"

#include <algorithm>

namespace feedhold {

namespace {

/// `AddRegPart`
bool isCamelCase(std::string_view word) {
  const auto isUpper = [](char c) { return c >= 'A' && c <= 'Z'; };
  return word.size() > 1 && isUpper(word[0]) && isLetter(word[1]) && !isUpper(word[1]);
}

} // namespace

void LineScanner::scanHead() {
  if (scanMachineHead())
    return;
  scanLabelP();
  if (peek() == '/') {
    ++at_;
    if (isDigit(peek()))
      ++at_;
    skipBlanks();
  }
  switch (peek()) {
  case '%': scanPercent(); return;
  case '$': scanDollar(); return;
  case '#': scanHashHead(); return;
  case '@': scanAtHead(); return;
  case ':': scanColon(); return;
  case '<': scanAngle(); return;
  case '!': scanWaiting(); return;
  case '&':
    if (beginsUpper(rest(), "&F=")) {
      count(TextSignal::FanucFolderLine);
      hasWord_ = true;
      stop();
    }
    return;
  case '[':
    if (peek(1) == '*') { // a line of an encrypted program
      count(TextSignal::FanucEncryption);
      hasWord_ = true;
      stop();
      return;
    }
    if (isSimulatorDirective(rest())) {
      hasWord_ = true;
      stop();
      return;
    }
    if (const std::size_t end = rest().rfind(']'); end != std::string_view::npos) {
      const std::string_view after = trimmed(rest().substr(end + 1));
      if (beginsUpper(after, "M99") || beginsUpper(after, "M97"))
        count(TextSignal::HaasConditionalReturn);
    }
    return;
  default: break;
  }
  if (isDigit(peek()))
    scanNumberHead();
  else if (toUpper(peek()) == 'O')
    scanOWord();
  else if (toUpper(peek()) == 'M')
    scanPrinterCommand();
  else if (beginsUpper(rest(), "DEFINE <")) {
    count(TextSignal::CentroidStatement);
    hasWord_ = true;
    stop();
  }
}

/// The rest of a line that begins with `%`: leader text, unless a language makes something of it.
void LineScanner::scanPercent() {
  ++at_;
  hasWord_ = true;
  const char next = peek();
  const bool isOldSinumerik = beginsUpper(rest(), "MPF") || beginsUpper(rest(), "SPF"); // 810, 820: `%MPF1005`
  if (beginsUpper(rest(), "_N_") || (isOldSinumerik && rest().size() > 3 && isDigit(rest()[3]))) {
    count(TextSignal::SinumerikFile);
  } else if (beginsUpper(rest(), "@MACRO")) {
    count(TextSignal::SyntecMarker);
  } else if (isLetter(next) && (equalsUpper(rest(), "WAIT") || rest().find('=') != std::string_view::npos)) {
    count(TextSignal::SenderStatement);
  } else if (isDigit(next)) {
    if (takeNumber().digits >= 3 && scan_.codeLines == 0 && scan_.count(TextSignal::FagorNumber) == 0)
      count(TextSignal::FagorNumber);
  } else if (isLetter(next) && rest().find(",MX") != std::string_view::npos) {
    count(TextSignal::FagorStatement);
    count(TextSignal::FagorStatement);
  } else if (toUpper(next) == 'O' || next == ':' || isBlank(next) || next == '(') {
    skipBlanks();
    return;
  }
  stop();
}

/// A program number of ISO tapes, a remark above the O word, or a block of Acramatic.
void LineScanner::scanColon() {
  if (isDigit(peek(1))) {
    count(TextSignal::ProgramNumber);
    ++at_;
    takeNumber();
    hasWord_ = true;
  } else if (peek(1) == '(') {
    ++at_;
  } else if (beginsUpper(rest(), ":G") && isDigit(peek(2))) {
    count(TextSignal::AlignmentBlock);
    ++at_;
  }
}

/// Windows batch files begin their commands so, too.
void LineScanner::scanAtHead() {
  static constexpr std::string_view kBatch[] = {"ECHO", "IF", "SET", "SETLOCAL", "REM", "CALL", "START"};
  if (!isLetter(peek(1)))
    return;
  ++at_;
  if (isOneOf(peekRun(), kBatch))
    hasUnknown_ = true;
  else
    count(TextSignal::CompilerDirective);
  stop();
}

/// `!L10`, `!2L10`: the systems of a machine wait for each other.
void LineScanner::scanWaiting() {
  ++at_;
  if (isDigit(peek()))
    takeNumber();
  if (toUpper(peek()) == 'L' && isDigit(peek(1)))
    count(TextSignal::SystemMark);
  else
    hasUnknown_ = true;
  stop();
}

void LineScanner::scanDollar() {
  static constexpr std::string_view kControl[] = {"IF",  "ELSE",   "ELSEIF", "ENDIF",   "WHILE",     "ENDWHILE",
                                                  "FOR", "ENDFOR", "GOTO",   "SWITCH",  "ENDSWITCH", "CASE",
                                                  "DO",  "ENDDO",  "BREAK",  "DEFAULT", "CONTINUE"};
  static constexpr std::string_view kDirective[] = {"INCLUDE", "LIST", "NOLIST", "EJECT", "MIX"};
  // Homing, jogging, switches of states, and settings by name or by path.
  static constexpr std::string_view kGrbl[] = {"H", "HX", "HY",  "HZ",  "J",   "G",   "I",     "X",
                                               "C", "N",  "SLP", "TLR", "TPW", "RST", "ALARM", "SETTINGS"};
  ++at_;
  if (isDigit(peek())) { // `$2`: what follows is for the second system of the machine; `$110=1000`: a setting
    takeNumber();
    skipBlanks();
    if (peek() == '=' && isDigit(peek(1)))
      count(TextSignal::GrblCommand);
    else if (atEnd())
      count(TextSignal::SystemMark);
    else
      hasUnknown_ = true;
    stop();
    return;
  }
  const std::string_view run = takeRun();
  if ((equalsUpper(run, "DO") || equalsUpper(run, "AO")) && isDigit(peek())) { // `$DO0.1=0`: an output
    count(TextSignal::AerotechStatement);
    stop();
    return;
  }
  const bool isPath = run.size() > 1 && peek() == '/' && isLetter(peek(1));
  const bool isReading = peek() == '=' && beginsUpper(rest().substr(1), "READ"); // `$TCS=READ id=0`: uCNC
  const bool isCommand = isReading || (isOneOf(run, kGrbl) && (atEnd() || peek() == '=' || isBlank(peek())));
  if (isPath || isCommand) {
    count(TextSignal::GrblCommand);
  } else if (isOneOf(run, kControl)) {
    count(TextSignal::DollarControl);
  } else if (isOneOf(run, kDirective)) {
    count(TextSignal::CompilerDirective);
  } else if (trimmed(line_).back() == '%') {
    count(TextSignal::OkumaFile);
  } else if (isCamelCase(run)) {
    count(TextSignal::SimulatorCommand);
  } else {
    hasUnknown_ = true;
  }
  stop();
}

/// A line whose `#` is followed by no number: macro lines of Fadal, commands of ISG, sections for a simulator, a
/// heading, a remark.
void LineScanner::scanHashHead() {
  static constexpr std::string_view kFadal[] = {"PRINT", "INPUT", "GOTO", "WAIT", "CLEAR", "RETURN"};
  static constexpr std::string_view kIsg[] = {"VAR", "ENDVAR", "MSG", "COMMENT", "ERROR", "CS", "TRAFO", "SLOPE"};
  const char next = peek(1);
  if (next == '#' && isLetter(peek(2))) {
    count(TextSignal::SimulatorSection);
    stop();
  } else if (next == ':') {
    count(TextSignal::FadalLine);
    stop();
  } else if (isLetter(next)) {
    ++at_;
    const std::string_view run = takeRun();
    const bool isNumbered = run.size() == 1 && (toUpper(run[0]) == 'V' || toUpper(run[0]) == 'R') && isDigit(peek());
    if (isNumbered || isOneOf(run, kFadal) ||
        (equalsUpper(run, "IF") && rest().find("THEN") != std::string_view::npos)) {
      count(TextSignal::FadalLine);
    } else if (isOneOf(run, kIsg)) {
      count(TextSignal::IsgCommand);
    } else {
      hasUnknown_ = true;
    }
    stop();
  }
}

/// Klartext numbers its blocks without an address.
void LineScanner::scanNumberHead() {
  static constexpr std::string_view kFirst[] = {"L",    "C",    "CC",  "CR", "CT", "RND",  "LBL", "FN",
                                                "CYCL", "STOP", "CHF", "LP", "CP", "APPR", "DEP", "Q"};
  takeNumber();
  if (!isBlank(peek()))
    return;
  skipBlanks();
  const std::string_view run = peekRun();
  if (isOneOf(run, kFirst)) {
    count(TextSignal::KlartextBlock);
    at_ += run.size() == 1 && toUpper(run[0]) == 'Q' ? 0 : run.size();
  }
}

/// `o100 while`, `o<name> call`; anything else after O is left to the words.
bool LineScanner::scanOWord() {
  static constexpr std::string_view kAfterO[] = {"SUB",    "ENDSUB",    "IF",       "ELSEIF",   "ELSE",
                                                 "ENDIF",  "WHILE",     "ENDWHILE", "CALL",     "REPEAT",
                                                 "RETURN", "ENDREPEAT", "BREAK",    "CONTINUE", "DO"};
  const std::size_t start = at_++;
  skipBlanks();
  if (peek() == '<') {
    const std::size_t end = line_.find('>', at_);
    at_ = end == std::string_view::npos ? start : end + 1;
  } else if (isDigit(peek())) {
    takeNumber();
  } else {
    at_ = start;
  }
  if (at_ != start) {
    skipBlanks();
    const std::string_view run = peekRun();
    if (isOneOf(run, kAfterO)) {
      count(TextSignal::OWord);
      hasOWord_ = true;
      hasWord_ = true;
      at_ += run.size();
      return true;
    }
  }
  at_ = start;
  return false;
}

/// `(FALSE);` or `("#100");` and the end of the line behind a name: in NC programs parentheses hold remarks.
bool LineScanner::isSimulatorCall() const {
  if (peek() != '(')
    return false;
  const std::string_view call = trimmed(rest());
  const std::string_view last = call.substr(0, call.rfind(");"));
  return call.ends_with(");") && (last.ends_with('"') || last.ends_with("FALSE") || last.ends_with("TRUE"));
}

} // namespace feedhold
