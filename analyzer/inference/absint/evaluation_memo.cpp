#include "inference/absint/evaluation_memo.h"

#include "inference/absint/abstract_interpretation.h"

#include <algorithm>

namespace feedhold {

namespace {

/// A variable that keeps what was written, under its own number.
bool isPlain(const Dialect &dialect, std::uint32_t variable) {
  const VariableRange *range = variable >= kFirstNamedVariable ? nullptr : findVariable(dialect, variable);
  if (!range)
    return false;
  if (range->kind == VariableKind::Local)
    return variable <= kLocalVariables;
  const bool isKept = range->kind == VariableKind::Common || range->kind == VariableKind::Retentive;
  return isKept && range->role == VariableRole::Plain && range->access == VariableAccess::ReadWrite &&
         !findBitWord(dialect, variable) && cellOf(dialect, variable) == variable;
}

bool readsTheMachine(FunctionKind function) {
  return function == FunctionKind::Adp || function == FunctionKind::Prm || function == FunctionKind::Ax ||
         function == FunctionKind::AxNumber || function == FunctionKind::Exists;
}

/// The variables of an expression of which nothing else is read; absent when there is something else.
std::optional<std::vector<std::uint32_t>> variablesOf(const SyntaxTree &tree, const Dialect &dialect,
                                                      ExpressionId root) {
  std::vector<std::uint32_t> variables;
  for (const ExpressionId id : subexpressions(tree, root)) {
    const auto &node = tree.expressions[id].node;
    const auto *call = std::get_if<FunctionCall>(&node);
    if (std::holds_alternative<IndirectVariable>(node) || std::holds_alternative<NamedVariable>(node) ||
        std::holds_alternative<BrokenExpression>(node) || (call && readsTheMachine(call->function)))
      return std::nullopt;
    if (!std::holds_alternative<NumberedVariable>(node))
      continue;
    const auto number = variableNumber(tree, id);
    if (!number || !isPlain(dialect, *number))
      return std::nullopt;
    if (std::find(variables.begin(), variables.end(), *number) == variables.end())
      variables.push_back(*number);
  }
  return variables;
}

bool isSymbolOf(const std::optional<Origin> &origin, const AbstractValue &value) {
  return value.origin() && value.origin()->symbol == origin->symbol;
}

bool isFree(const std::optional<Origin> &origin) { return !origin || origin->symbol == kZeroSymbol; }

/// Equal but for the name of the symbol.
bool isAlike(const AbstractValue &then, const AbstractValue &now) {
  if (then.mayBeVacant() != now.mayBeVacant() || then.mayBeNumber() != now.mayBeNumber() ||
      then.origin().has_value() != now.origin().has_value() || then.number() != now.number())
    return false;
  return !then.origin() ||
         (then.origin()->offset == now.origin()->offset && isFree(then.origin()) == isFree(now.origin()));
}

} // namespace

EvaluationMemo::Entry *EvaluationMemo::entryOf(const SyntaxTree &tree, const Dialect &dialect,
                                               ExpressionId expression) {
  const Expression *key = &tree.expressions[expression];
  auto found = entries_.find(key);
  if (found == entries_.end()) {
    if (entries_.size() >= kMostEntries)
      return nullptr;
    found = entries_.emplace(key, Entry{}).first;
    if (auto variables = variablesOf(tree, dialect, expression)) {
      found->second.variables = std::move(*variables);
      found->second.isPure = true;
    }
  }
  return found->second.isPure ? &found->second : nullptr;
}

bool EvaluationMemo::isSamePattern(const std::vector<AbstractValue> &then, const std::vector<AbstractValue> &now) {
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (!isAlike(then[i], now[i]))
      return false;
    for (std::size_t j = 0; j < i && now[i].origin(); ++j)
      if (isSymbolOf(then[i].origin(), then[j]) != isSymbolOf(now[i].origin(), now[j]))
        return false;
  }
  return true;
}

EvaluationMemo::Evaluation EvaluationMemo::renamed(const Entry &entry) const {
  Evaluation evaluation = entry.evaluation;
  if (entry.symbolOf < now_.size())
    evaluation.value =
        evaluation.value.withOrigin(Origin{now_[entry.symbolOf].origin()->symbol, evaluation.value.origin()->offset});
  return evaluation;
}

void EvaluationMemo::remember(const SyntaxTree &tree, ExpressionId expression, Evaluation evaluation) {
  const auto found = entries_.find(&tree.expressions[expression]);
  if (found == entries_.end() || !found->second.isPure)
    return;
  Entry &entry = found->second;
  const std::optional<Origin> &origin = evaluation.value.origin();
  const auto source =
      isFree(origin) ? now_.end() : std::find_if(now_.begin(), now_.end(), [&](const AbstractValue &value) {
        return isSymbolOf(origin, value);
      });
  entry.isKnown = isFree(origin) || source != now_.end();
  entry.symbolOf = static_cast<std::size_t>(source - now_.begin());
  entry.values.swap(now_);
  entry.evaluation = std::move(evaluation);
}

} // namespace feedhold
