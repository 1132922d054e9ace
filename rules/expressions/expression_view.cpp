// How rules look at expressions; see the header.
#include "rules/expressions/expression_view.h"

#include "base/support/match.h"
#include "base/support/text.h"

#include <algorithm>

namespace feedhold::rules {
namespace {

bool isVariable(const SyntaxTree &tree, ExpressionId id) {
  return as<NumberedVariable>(tree, id) || as<IndirectVariable>(tree, id) || as<NamedVariable>(tree, id);
}

bool readsMachine(const SyntaxTree &tree, ExpressionId id) {
  const auto *call = as<FunctionCall>(tree, id);
  return call && (call->function == FunctionKind::Prm || call->function == FunctionKind::Ax ||
                  call->function == FunctionKind::AxNumber);
}

} // namespace

const Statement *firstStatement(const SyntaxTree &tree, BlockId block) {
  for (const Statement &statement : tree.statementsOf(block))
    if (!statement.nested)
      return &statement;
  return nullptr;
}

std::optional<ExpressionId> conditionOf(const Statement &statement) {
  using Found = std::optional<ExpressionId>;
  return std::visit(Overloaded{[](const If &node) -> Found { return node.condition; },
                               [](const ElseIf &node) -> Found { return node.condition; },
                               [](const While &node) -> Found { return node.condition; },
                               [](const ConditionalWords &node) -> Found { return node.condition; },
                               [](const auto &) -> Found { return std::nullopt; }},
                    statement.node);
}

bool isVacant(const FileContext &context, ExpressionId id) {
  const auto number = variableNumber(context.tree, unwrapped(context.tree, id));
  if (!number)
    return false;
  const VariableRange *range = findVariable(context.dialect, *number);
  return *number == kVacantVariable || (range && range->kind == VariableKind::Vacant);
}

bool isConstant(const SyntaxTree &tree, ExpressionId root) {
  const auto nodes = subexpressions(tree, root);
  return std::none_of(nodes.begin(), nodes.end(), [&](ExpressionId id) {
    return isVariable(tree, id) || readsMachine(tree, id) || as<BrokenExpression>(tree, id);
  });
}

bool readsLiveValue(const FileContext &context, ExpressionId root) {
  const auto nodes = subexpressions(context.tree, root);
  return std::any_of(nodes.begin(), nodes.end(), [&](ExpressionId id) {
    if (!isVariable(context.tree, id))
      return readsMachine(context.tree, id);
    const auto number = variableNumber(context.tree, id);
    const VariableRange *range = number ? findVariable(context.dialect, *number) : nullptr;
    return !range || range->kind == VariableKind::System;
  });
}

std::vector<SumTerm> termsOf(const SyntaxTree &tree, ExpressionId root) {
  std::vector<SumTerm> terms;
  std::vector<SumTerm> open{{root, false}};
  while (!open.empty()) {
    const SumTerm term{unwrapped(tree, open.back().value), open.back().isMinus};
    open.pop_back();
    const auto *operation = as<BinaryOperation>(tree, term.value);
    const auto *negation = as<Negation>(tree, term.value);
    if (operation && (operation->op == OperatorKind::Add || operation->op == OperatorKind::Subtract)) {
      open.push_back({operation->right, term.isMinus != (operation->op == OperatorKind::Subtract)});
      open.push_back({operation->left, term.isMinus});
    } else if (negation) {
      open.push_back({negation->operand, !term.isMinus});
    } else {
      terms.push_back(term);
    }
  }
  return terms;
}

bool sameText(const FileContext &context, Span left, Span right) {
  const std::string_view a = context.text(left);
  const std::string_view b = context.text(right);
  const auto skipBlanks = [](std::string_view text, std::size_t at) {
    while (at < text.size() && isBlank(text[at]))
      ++at;
    return at;
  };
  std::size_t i = skipBlanks(a, 0);
  std::size_t k = skipBlanks(b, 0);
  while (i < a.size() && k < b.size() && toUpper(a[i]) == toUpper(b[k])) {
    i = skipBlanks(a, i + 1);
    k = skipBlanks(b, k + 1);
  }
  return i == a.size() && k == b.size();
}

} // namespace feedhold::rules
