// Conditions of a program as clauses of a contract can say them: comparisons over the values on entry.
#pragma once

#include "inference/absint/flow_facts.h"

#include <optional>
#include <string>
#include <vector>

namespace feedhold::draft {

/// `#24 LT 10`, with its operands as the program writes them.
struct Comparison {
  std::string left;
  OperatorKind relation;
  std::string right;
  std::optional<std::uint32_t> variable = {}; // the left side is this variable alone
  std::optional<Decimal> constant = {};       // the right side is this number
  bool isVacancy = false;                     // the right side is `#0`
  std::vector<std::uint32_t> reads = {};      // variables of both sides, ascending

  friend bool operator==(const Comparison &a, const Comparison &b) {
    return a.left == b.left && a.relation == b.relation && a.right == b.right;
  }
};
std::string textOf(const Comparison &comparison);
Comparison opposite(Comparison comparison);

/// One of the comparisons holds.
using Alternatives = std::vector<Comparison>;
/// `[#1 EQ 1] OR [#1 EQ 2]`; a single one stands without brackets.
std::string textOf(const Alternatives &alternatives);

/// What variables hold where a condition stands.
class EntryValues {
public:
  explicit EntryValues(const FlowFacts &facts) : facts_(facts) {}

  /// All of these hold exactly where the condition is as told.  Absent: it speaks of something else than what the
  /// program found on entry, or is too long.
  std::optional<std::vector<Alternatives>> conditionsOf(ExpressionId condition, bool holds) const;
  /// The value of a variable is vacant until the program gives it this one.
  void addDefault(std::uint32_t variable) { defaults_.push_back(variable); }
  /// The variable whose value on entry the expression holds; a copy counts as what it is a copy of.
  std::optional<std::uint32_t> onEntry(ExpressionId variable) const;
  /// The text of an expression over the values on entry; absent when it reads anything else.
  std::optional<std::string> textOverEntry(ExpressionId expression) const;

private:
  std::optional<std::vector<Alternatives>> joined(const BinaryOperation &operation, bool holds) const;
  std::optional<Comparison> comparisonOf(const BinaryOperation &operation) const;
  bool isDefaulted(std::uint32_t variable) const;

  const FlowFacts &facts_;
  std::vector<std::uint32_t> defaults_;
};

/// The product of two conditions: all alternatives of one with all of the other.  Absent: it is too long.
std::optional<std::vector<Alternatives>> either(const std::vector<Alternatives> &a, const std::vector<Alternatives> &b);

/// A local or common variable: what `@PARAM` and `@GLOBAL` can name.
bool isInput(const Dialect &dialect, std::uint32_t variable);

/// Some run comes to an M99 and back to a caller.  An M99 of a part that the program calls itself (M97) is another one.
bool comesBack(const FlowFacts &facts);

/// The only assignment to the variable in the text of the program; null: there is none, there are several, or one to a
/// computed number.
const Assignment *onlyAssignment(const FlowFacts &facts, std::uint32_t variable);

} // namespace feedhold::draft
