// Comments of a text whose language is not known yet.
#include "language/dialect/comment_signals.h"

#include "base/support/text.h"
#include "language/dialect/text_keywords.h"

#include <algorithm>
#include <span>

namespace feedhold {
namespace {

void count(TextSignal signal, TextScan &scan) { ++scan.counts[static_cast<std::size_t>(signal)]; }

bool beginsWithAny(std::string_view text, std::span<const std::string_view> begins) {
  return std::any_of(begins.begin(), begins.end(), [text](std::string_view begin) { return beginsUpper(text, begin); });
}

/// `(IF (P1 EQ 2) ..)`, `(IF P100 EQ 5 GOTO N20)`, `(CALL 12)`, `(P12 = ..)`, `(RPT N1,N9)`, `(RET)`.
bool isFagorStatement(std::string_view text) {
  static constexpr std::string_view kCalls[] = {"CALL ", "PCALL ", "MCALL ", "SUB "};
  for (const std::string_view call : kCalls)
    if (beginsUpper(text, call) && text.size() > call.size() && isDigit(text[call.size()]))
      return true;
  const bool isAssignment = beginsUpper(text, "P") && text.size() > 1 && isDigit(text[1]) && text.find('=') < 7;
  const bool isCondition =
      beginsUpper(text, "IF (") || (beginsUpper(text, "IF P") && text.size() > 4 && isDigit(text[4]));
  return isAssignment || isCondition || beginsUpper(text, "RPT N") || equalsUpper(text, "RET");
}

/// `(ORGX54=0, ORGZ54=90)`: the origin of G54 on an axis.
bool isFagorOrigin(std::string_view text) {
  return beginsUpper(text, "ORG") && text.size() > 6 && isLetter(text[3]) && text[4] == '5' && isDigit(text[5]) &&
         text[6] == '=';
}

/// `(RPT,5)`, `(GTO,START,E1>5)`, `(CLS,PROG1)`: three letters and a comma.
bool isOsaiStatement(std::string_view text) {
  static constexpr std::string_view kStatements[] = {"RPT,", "GTO,", "CLS,", "UGS,", "DIS,", "UAO,", "UTO,", "UOT,",
                                                     "UIO,", "MIR,", "ROT,", "SCF,", "SPA,", "EPP,", "DPT,", "UDA,"};
  return beginsWithAny(text, kStatements);
}

/// `3" MITSUBISHI FACE MILL`, `HAAS VISE`: makers of controls also sell tools and vices.
bool namesEquipment(std::string_view text) {
  static constexpr std::string_view kEquipment[] = {"MILL",   "DRILL", "TAP",     "INSERT", "REAM", "BORING",
                                                    "CUTTER", "TOOL",  "CARBIDE", "GRADE",  "VISE", "VICE",
                                                    "CHUCK",  "JAW",   "HOLDER",  "PALLET", "PROBE"};
  bool isStart = true;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (isStart && beginsWithAny(text.substr(i), kEquipment))
      return true;
    isStart = !isLetter(text[i]);
  }
  return false;
}

/// Makers' names at the beginning of words; each once for the whole text, since a comment is no code.
void countNames(std::string_view text, TextScan &scan) {
  static constexpr struct {
    std::string_view begin;
    TextSignal signal;
  } kNames[] = {
      {"FANUC", TextSignal::FanucComment},           {"HAAS", TextSignal::HaasComment},
      {"MITSUBISHI", TextSignal::MitsubishiComment}, {"MELDAS", TextSignal::MitsubishiComment},
      {"MAZAK", TextSignal::MitsubishiComment},      {"MAZATROL", TextSignal::MitsubishiComment},
      {"30I-", TextSignal::FanucSeries30Comment},    {"31I-", TextSignal::FanucSeries30Comment},
      {"32I-", TextSignal::FanucSeries30Comment},    {"0I-F", TextSignal::FanucSeries30Comment},
      {"0I-M", TextSignal::FanucSeries0Comment},     {"0I-T", TextSignal::FanucSeries0Comment},
      {"0I-C", TextSignal::FanucSeries0Comment},     {"0I-D", TextSignal::FanucSeries0Comment},
      {"16I-", TextSignal::FanucSeries0Comment},     {"18I-", TextSignal::FanucSeries0Comment},
      {"21I-", TextSignal::FanucSeries0Comment},     {"LINUXCNC", TextSignal::NgcComment},
      {"PATHPILOT", TextSignal::NgcComment},         {"GRBL", TextSignal::GrblComment},
  };
  bool isStart = true;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = toUpper(text[i]);
    if (isStart && (c == 'F' || c == 'G' || c == 'H' || c == 'M' || c == 'L' || c == 'P' || (c >= '0' && c <= '3'))) {
      for (const auto &name : kNames)
        if (beginsUpper(text.substr(i), name.begin) && scan.count(name.signal) == 0 && !namesEquipment(text))
          count(name.signal, scan);
    }
    isStart = !isLetter(c) && !isDigit(c);
  }
}

} // namespace

/// People nest parentheses although controls do not; what stands outside the outer pair is code for certain.
std::size_t commentLength(std::string_view text) {
  std::size_t depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(')
      ++depth;
    else if (text[i] == ')' && --depth == 0)
      return i + 1;
  }
  const std::size_t first = text.find(')');
  return first == std::string_view::npos ? text.size() : first + 1;
}

CommentLanguage scanComment(std::string_view comment, CommentPlace place, TextScan &scan) {
  static constexpr std::string_view kRsComments[] = {"DEBUG,", "PRINT,", "PROBEOPEN", "ABORT,", "LOG,"};
  static constexpr std::string_view kDialogs[] = {"DLG,", "DLGNAME,", "DLGNEW", "DLGSHOW"};
  const std::size_t inner = comment.size() > 1 && comment.back() == ')' ? comment.size() - 2 : comment.size() - 1;
  const std::string_view text = trimmed(comment.substr(1, inner));
  countNames(text, scan);
  if (beginsWithAny(text, kRsComments)) {
    count(TextSignal::RsComment, scan);
    return CommentLanguage::Foreign;
  }
  if (beginsWithAny(text, kDialogs)) {
    count(TextSignal::PlanetMark, scan);
    return CommentLanguage::Foreign;
  }
  if (place == CommentPlace::Alone && isOsaiStatement(text)) {
    count(TextSignal::OsaiStatement, scan);
    return CommentLanguage::Foreign;
  }
  if (place == CommentPlace::Alone && isFagorOrigin(text)) {
    constexpr int kCertain = 5; // the name says it: once is enough
    for (int times = 0; times < kCertain; ++times)
      count(TextSignal::FagorStatement, scan);
    return CommentLanguage::Foreign;
  }
  if (place == CommentPlace::Alone && isFagorStatement(text)) {
    count(TextSignal::FagorStatement, scan);
    return CommentLanguage::Foreign;
  }
  return CommentLanguage::Any;
}

} // namespace feedhold
