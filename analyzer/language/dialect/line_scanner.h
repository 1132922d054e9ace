// The state of the scan of one line.  It is not the lexer: it has to make sense of twelve languages and of prose, and
// may be wrong about single lines.  line_heads.cpp reads how a line begins, line_signals.cpp what follows.
#pragma once

#include "base/support/text.h"
#include "language/dialect/text_keywords.h"
#include "language/dialect/text_signals.h"

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace feedhold {

constexpr bool isNameCharacter(char c) { return isLetter(c) || c == '_'; }

struct Number {
  std::uint32_t whole = 0; // at most nine digits
  std::uint32_t digits = 0;
  bool hasFraction = false;
  char tenths = '0'; // first digit of the fraction
};

class LineScanner {
public:
  LineScanner(std::string_view line, TextScan &scan) : line_(line), scan_(scan) {}

  void run() {
    skipBlanks();
    if (atEnd())
      return;
    scanHead();
    while (!atEnd())
      scanToken();
    countCombinations();
    sortLine();
  }

private:
  bool atEnd() const { return at_ >= line_.size(); }
  char peek(std::size_t ahead = 0) const { return at_ + ahead < line_.size() ? line_[at_ + ahead] : '\0'; }
  std::string_view rest() const { return line_.substr(at_); }
  void skipBlanks() {
    while (isBlank(peek()))
      ++at_;
  }
  void stop() { at_ = line_.size(); }

  void count(TextSignal signal) {
    ++scan_.counts[static_cast<std::size_t>(signal)];
    hasSignal_ = true;
  }

  void countCLike() {
    count(TextSignal::CLikeOperator);
    hasCLike_ = true;
  }

  /// A mark that says nothing about the language of the line.
  void note(TextSignal signal) { ++scan_.counts[static_cast<std::size_t>(signal)]; }

  std::string_view takeRun() {
    const std::size_t start = at_;
    while (isNameCharacter(peek()))
      ++at_;
    return line_.substr(start, at_ - start);
  }

  std::string_view peekRun() const {
    std::size_t end = at_;
    while (end < line_.size() && isNameCharacter(line_[end]))
      ++end;
    return line_.substr(at_, end - at_);
  }

  Number takeNumber() {
    Number number;
    for (; isDigit(peek()); ++at_) {
      if (++number.digits <= 9)
        number.whole = number.whole * 10 + static_cast<std::uint32_t>(peek() - '0');
    }
    if (peek() == '.') {
      number.hasFraction = isDigit(peek(1));
      number.tenths = number.hasFraction ? peek(1) : '0';
      ++at_;
      while (isDigit(peek()))
        ++at_;
    }
    return number;
  }

  void scanHead();
  void scanPercent();
  void scanAtHead();
  void scanColon();
  void scanDollar();
  void scanWaiting();
  void scanPrinterCommand();
  bool scanHobbyMark(char mark);
  void scanTemplateName();
  void scanHashHead();
  void scanNumberHead();
  bool scanOWord();
  void scanToken();
  void scanLetters();
  void scanLongRun(std::string_view run);
  void scanJammed(std::string_view run);
  bool scanPair(std::string_view run);
  std::optional<TextSignal> pairSignal(std::string_view run, bool isFirst, bool isJoined) const;
  void scanKeyword(const Keyword &keyword);
  void noteBranch();
  void scanCondition();
  void scanWord(char letter);
  void scanNumberedWord(char letter, const Number &number);
  void scanGCode(const Number &number);
  void scanMCode(const Number &number);
  void scanEquals(char letter);
  void scanHash();
  void scanVariable(const Number &number);
  void scanComment();
  void scanAngle();
  void scanString();
  void scanMark(char c);
  bool scanErosion(char letter, const Number &number);
  void scanErosionTool(const Number &number);
  std::size_t conditionNumbers() const;
  bool isBufferHead() const;
  bool isDrillHead() const;
  bool isRobotLine() const;
  bool isXilogLine() const;
  bool scanMachineHead();
  void scanLabelP();
  void noteContour();
  void scanAt();
  bool isTurningCycle() const;
  void countLatheMarks();
  void countGCodeSystem();
  bool hasAnyCode(std::size_t first, std::size_t last) const;
  bool hasLapCode() const;
  void countFadalMarks();
  bool isBareIf() const;
  bool isSimulatorCall() const;
  bool isNgcLine() const;
  bool isEngraving() const;
  void countCombinations();
  void sortLine();

  static constexpr std::uint32_t lettersOf(std::string_view letters) {
    std::uint32_t bits = 0;
    for (const char letter : letters)
      bits |= 1U << (letter - 'A');
    return bits;
  }
  bool hasLetter(char letter) const { return (letters_ >> (letter - 'A') & 1U) != 0; }
  bool hasNumber(char letter) const { return (numbered_ >> (letter - 'A') & 1U) != 0; }

  std::string_view line_;
  TextScan &scan_;
  std::size_t at_ = 0;
  std::uint32_t letters_ = 0;  // addresses seen
  std::uint32_t numbered_ = 0; // those with a number, not a variable
  bool hasWord_ = false;       // something that NC programs are made of
  bool hasComment_ = false;
  bool hasUnknown_ = false;
  bool hasSignal_ = false;
  bool hasHash_ = false;
  bool hasIf_ = false;
  bool hasCondition_ = false; // IF or WHILE
  bool endsWithThen_ = false;
  bool hasOWord_ = false;
  bool hasProbing_ = false; // G38
  bool hasG65_ = false;
  bool hasM98_ = false;
  bool hasM97_ = false;
  bool hasRelay_ = false; // M59, M69
  bool hasTurningCycle_ = false;
  bool hasG50_ = false;
  bool hasG92_ = false;
  bool hasG96_ = false;
  bool hasCode_ = false; // a G or M code
  bool hasG4_ = false;
  bool hasG15_ = false;
  bool hasG31_ = false;
  bool hasG90_ = false;
  bool hasG91_ = false;
  std::bitset<100> gCodes_;   // whole ones
  std::uint32_t codes_ = 0;   // G codes
  bool hasHome_ = false;      // G28, G30, G53, G92: no cut
  bool hasVariableP_ = false; // `P#100`
  bool hasNegativeP_ = false; // `P-1`
  bool hasM82_ = false;
  bool hasM84_ = false;
  int erosionTools_ = 0;
  bool hasDecimalD_ = false;
  bool hasOffsetE_ = false;     // `E1`: a whole number of at most two digits
  bool hasSubprogramL_ = false; // `L100`: a whole number of at least three digits
  bool hasCLike_ = false;       // an operator that Macro B does not have
  bool hasBareDo_ = false;      // `DO` without a number, at the end
  bool hasG64_ = false;
  std::uint32_t contourFirst_ = 0; // P
  std::uint32_t contourLast_ = 0;  // Q
};

} // namespace feedhold
