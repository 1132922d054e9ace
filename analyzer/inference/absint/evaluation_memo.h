// EvaluationMemo: the values of expressions, kept from one passage through a program to the next.
//
// A loop is gone through until nothing changes any more, and then once or twice to draw bounds tighter; most of its
// statements read each time what they have read the last time.
//
// The value of constants, arithmetic and variables known by number depends on the values of these variables alone, and
// on their symbols only as far as two of them are the same: evaluation asks for no more.  With other symbols in the
// same pattern the value is the same one, of the other symbol.
#pragma once

#include "inference/domain/value.h"
#include "language/dialect/dialect.h"
#include "language/syntax/tree.h"

#include <optional>
#include <unordered_map>
#include <vector>

namespace feedhold {

class EvaluationMemo {
public:
  struct Evaluation {
    AbstractValue value;
    bool mayHaveDividedByZero = false;
  };

  /// What the expression has given when its variables held what read(variable) gives now; else absent.
  template <typename Read>
  std::optional<Evaluation> recall(const SyntaxTree &tree, const Dialect &dialect, ExpressionId expression,
                                   Read &&read) {
    Entry *entry = entryOf(tree, dialect, expression);
    if (!entry)
      return std::nullopt;
    now_.clear();
    for (const std::uint32_t variable : entry->variables)
      now_.push_back(read(variable));
    return entry->isKnown && isSamePattern(entry->values, now_) ? std::optional(renamed(*entry)) : std::nullopt;
  }
  /// Of the expression that recall() has not known just now.
  void remember(const SyntaxTree &tree, ExpressionId expression, Evaluation evaluation);

private:
  struct Entry {
    std::vector<std::uint32_t> variables;
    std::vector<AbstractValue> values; // of these variables, when it was evaluated
    Evaluation evaluation;
    std::size_t symbolOf = 0; // of the value: that of this one of `values`; beyond the last: no symbol, or that of zero
    bool isKnown = false;
    bool isPure = false; // nothing but constants, arithmetic and variables known by number
  };
  static constexpr std::size_t kMostEntries = 20'000; // of some 300 bytes each

  Entry *entryOf(const SyntaxTree &tree, const Dialect &dialect, ExpressionId expression);
  static bool isSamePattern(const std::vector<AbstractValue> &then, const std::vector<AbstractValue> &now);
  Evaluation renamed(const Entry &entry) const;

  std::unordered_map<const Expression *, Entry> entries_;
  std::vector<AbstractValue> now_; // of the last recall
};

} // namespace feedhold
