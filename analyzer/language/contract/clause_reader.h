// ClauseReader: a hand that goes through the text of one clause.  What it expects and does not find is the clause's one
// issue; from then on it gives back stand-ins, and who reads asks `failed()` before the clause is used.
#pragma once

#include "language/contract/contract.h"
#include "language/parse/parse.h"

#include <string>
#include <string_view>

namespace feedhold {

/// A range as it was read: for the checks.
struct ReadRange {
  ClauseId clause;
  Range range;
  Span span;
};

/// What all clauses of a file are read into.
struct ContractReading {
  const SourceFile &program;
  const SyntaxTree &programTree;
  const ProgramModel &model;
  const Dialect &dialect;
  FileContracts result = {};
  std::vector<ReadRange> ranges = {};
  std::vector<BlockId> jumpHeads = {}; // blocks to which a jump leads back; sorted
};

class ClauseReader {
public:
  ClauseReader(ContractReading &reading, ClauseId clause, Span body);

  bool failed() const { return issue_.has_value(); }
  const ContractIssue &issue() const { return *issue_; }
  void fail(ContractIssueKind kind, Span span, std::string detail);
  /// Malformed at the text that comes.
  void expected(std::string what);

  bool atEnd() const { return at_ >= end_; }
  void expectEnd();
  /// What comes up to the next blank; empty at the end.
  Span ahead() const;
  std::string_view text(Span span) const { return source_.text(span); }

  /// The letters, digits, `_`, `-` and `/` that come, when they begin with a letter and a blank or the end follows.
  std::optional<Span> peekName() const;
  bool at(std::string_view keyword) const;
  bool take(std::string_view keyword);
  bool takeSign(char sign);
  Span name(std::string_view what);
  /// An upper-case letter, one of `letters`, that begins a word: no letter follows.  Absent: something else comes.
  std::optional<char> peekLetter(std::string_view letters) const;
  std::optional<char> takeLetter(std::string_view letters);
  /// The letter, whatever follows.
  bool takeAddress(char letter);
  /// `120`
  std::uint32_t integer(std::string_view what);
  /// `#21`
  struct Variable {
    std::uint32_t number = 0;
    Span span = {};
  };
  Variable variable();

  /// Up to a blank, a comma or `..` outside of brackets.
  ExpressionId value(std::string_view what);
  /// `1..[#2/2]`, `..5`, `0..`, `..`
  Range range(std::string_view what);
  /// `5.`: both ends are it.
  Range valueOrRange(std::string_view what);
  bool hasUpperEnd(bool spacedBefore);
  /// All that is left.
  ExpressionId condition(FindReserved reserved);
  ExpressionId expression(FindReserved reserved);

private:
  void skipBlanks();
  char sign(std::uint32_t offset) const { return offset < end_ ? source_.text()[offset] : '\0'; }
  /// Where an operand that begins at `begin` ends.
  std::uint32_t operandEnd(std::uint32_t begin) const;
  bool takeDots();
  ExpressionId parsed(Span part, FindReserved reserved);
  Span wordOfWithin(std::uint32_t begin) const;
  void refuseSyntax(const SyntaxIssue &issue);
  void refuseCondition(ExpressionId id);
  void refuseNumber(ExpressionId id);

  ContractReading &reading_;
  ClauseId clause_;
  ContractSourceId sourceId_;
  SourceFile source_;
  std::uint32_t at_;
  std::uint32_t end_;
  std::optional<ContractIssue> issue_;
};

/// `POS[X]`, `ENTRY[X]`, `OLD[#510]`.
std::optional<ReservedOperand> findPromiseOperand(std::string_view rest);
/// X, Y and Z.
std::optional<ReservedOperand> findPoint(std::string_view rest);
/// X and Z.
std::optional<ReservedOperand> findPointOfLathe(std::string_view rest);

} // namespace feedhold
