// How rules look at expressions: the node behind an id, with or without its brackets, and texts compared.
#pragma once

#include "findings/rule/rule.h"

#include <optional>
#include <variant>
#include <vector>

namespace feedhold::rules {

/// The node when it is of the kind asked for, else null.
template <typename Kind> const Kind *as(const SyntaxTree &tree, ExpressionId id) {
  return std::get_if<Kind>(&tree.expressions[id].node);
}

/// The same, looking through brackets and written `+` signs.
template <typename Kind> const Kind *asInside(const SyntaxTree &tree, ExpressionId id) {
  return as<Kind>(tree, unwrapped(tree, id));
}

/// The first statement of a block that is not the action of an IF; null when there is none.
const Statement *firstStatement(const SyntaxTree &tree, BlockId block);

/// The condition of an IF, an ELSEIF, a WHILE or of words under a condition.
std::optional<ExpressionId> conditionOf(const Statement &statement);

/// The expression is the vacant constant, whichever way it is written.
bool isVacant(const FileContext &context, ExpressionId id);

/// No variable and no machine setting below `root`: the control computes the same value every time.
bool isConstant(const SyntaxTree &tree, ExpressionId root);

/// Some variable below `root` is a system variable, or computed, and may change from one block to the next.
bool readsLiveValue(const FileContext &context, ExpressionId root);

/// A part of a sum, and whether it is subtracted.
struct SumTerm {
  ExpressionId value;
  bool isMinus;
};
/// `#1-[#2+3]`: #1, -#2, -3; of what is no sum, itself.
std::vector<SumTerm> termsOf(const SyntaxTree &tree, ExpressionId root);

/// Both texts are the same to the control: blanks and letter case do not count.
bool sameText(const FileContext &context, Span left, Span right);

} // namespace feedhold::rules
