// Keyword lookup by first letter.  Aliases ATN, SQR, RND: old spellings that controls still read.
#include "language/lex/keywords.h"

#include "base/support/check.h"
#include "base/support/text.h"

#include <algorithm>
#include <array>
#include <vector>

namespace feedhold {

namespace {

/// What may stand behind the short form of a keyword.
enum class Follow : std::uint8_t { None, Bracket, Operand, Anything };

struct Keyword {
  std::string_view spelling;
  TokenKind kind;
  std::uint8_t detail;
  Follow shortForm; // None: it has no short form
};

Follow shortFormOf(FunctionKind function) {
  // LN and AX are two letters already; POW has none (it would be read as POPEN), nor have AXNUM (AX is a function)
  // and EXISTS (EX is EXP).
  const bool none = function == FunctionKind::Ln || function == FunctionKind::Ax || function == FunctionKind::Pow ||
                    function == FunctionKind::AxNumber || function == FunctionKind::Exists;
  return none ? Follow::None : Follow::Bracket;
}

Follow shortFormOf(OperatorKind op) {
  const bool hasOne = op == OperatorKind::Modulo || op == OperatorKind::And || op == OperatorKind::Xor;
  return hasOne ? Follow::Operand : Follow::None;
}

Follow shortFormOf(ControlWord word) {
  switch (word) {
  case ControlWord::While:
  case ControlWord::Dprnt:
  case ControlWord::Bprnt: return Follow::Bracket;
  case ControlWord::Goto:
  case ControlWord::End: return Follow::Operand;
  case ControlWord::Then:
  case ControlWord::Popen:
  case ControlWord::Pclos: return Follow::Anything;
  case ControlWord::If:
  case ControlWord::Else:
  case ControlWord::ElseIf:
  case ControlWord::EndIf:
  case ControlWord::Do:
  case ControlWord::SetVn: return Follow::None;
  }
  FEEDHOLD_UNREACHABLE("the switch names every control word");
}

constexpr std::uint8_t asByte(auto value) { return static_cast<std::uint8_t>(value); }

using KeywordTable = std::array<std::vector<Keyword>, 26>;

KeywordTable buildTable() {
  KeywordTable table;
  const auto add = [&](Keyword keyword) {
    table[static_cast<std::size_t>(keyword.spelling.front() - 'A')].push_back(keyword);
  };
#define FUNCTION(kind, spelling)                                                                                       \
  add({spelling, TokenKind::Function, asByte(FunctionKind::kind), shortFormOf(FunctionKind::kind)});
#include "language/dialect/functions.def"
#define OPERATOR(kind, spelling)                                                                                       \
  if (isLetter(std::string_view(spelling).front()))                                                                    \
    add({spelling, TokenKind::Operator, asByte(OperatorKind::kind), shortFormOf(OperatorKind::kind)});
#include "language/dialect/operators.def"
#define CONTROL_WORD(kind, spelling)                                                                                   \
  add({spelling, TokenKind::ControlWord, asByte(ControlWord::kind), shortFormOf(ControlWord::kind)});
#include "language/dialect/control_words.def"
  add({"ATN", TokenKind::Function, asByte(FunctionKind::Atan), Follow::None});
  add({"SQR", TokenKind::Function, asByte(FunctionKind::Sqrt), Follow::None});
  add({"RND", TokenKind::Function, asByte(FunctionKind::Round), Follow::None});
  for (auto &row : table)
    std::stable_sort(row.begin(), row.end(),
                     [](const Keyword &a, const Keyword &b) { return a.spelling.size() > b.spelling.size(); });
  return table;
}

bool startsWith(std::string_view run, std::string_view spelling) {
  if (run.size() < spelling.size())
    return false;
  for (std::size_t i = 0; i < spelling.size(); ++i)
    if (toUpper(run[i]) != spelling[i])
      return false;
  return true;
}

bool follows(Follow follow, char next) {
  switch (follow) {
  case Follow::None: return false;
  case Follow::Bracket: return next == '[';
  case Follow::Operand: return next == '[' || next == '#' || next == '.' || isDigit(next);
  case Follow::Anything: return true;
  }
  FEEDHOLD_UNREACHABLE("the switch names every case");
}

} // namespace

KeywordMatch matchKeyword(std::string_view run, char next) {
  static const KeywordTable table = buildTable();
  const auto &row = table[static_cast<std::size_t>(toUpper(run.front()) - 'A')];
  for (const Keyword &keyword : row)
    if (startsWith(run, keyword.spelling))
      return {keyword.kind, keyword.detail, static_cast<std::uint8_t>(keyword.spelling.size()), false};
  if (run.size() != 2)
    return {};
  for (const Keyword &keyword : row)
    if (startsWith(run, keyword.spelling.substr(0, 2)) && follows(keyword.shortForm, next))
      return {keyword.kind, keyword.detail, 2, true};
  return {};
}

std::optional<OWordKind> findOWord(std::string_view run) {
  static constexpr std::string_view kSpellings[] = {
#define O_WORD(kind, spelling) spelling,
#include "language/dialect/o_words.def"
  };
  for (std::size_t i = 0; i < std::size(kSpellings); ++i)
    if (run.size() == kSpellings[i].size() && startsWith(run, kSpellings[i]))
      return static_cast<OWordKind>(i);
  return std::nullopt;
}

} // namespace feedhold
