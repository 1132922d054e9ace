// equality-with-vacant-arithmetic: `[#1+0]EQ#0`.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include <fmt/format.h>

namespace feedhold::rules::equality_with_vacant_arithmetic {
namespace {

/// Arithmetic and functions make a number even of vacant variables.  A sign and the reading of a setting are left
/// out: what they make of nothing is not documented.
bool isNeverVacant(const SyntaxTree &tree, ExpressionId id) {
  if (const auto *call = asInside<FunctionCall>(tree, id))
    return call->function != FunctionKind::Prm && call->function != FunctionKind::Ax &&
           call->function != FunctionKind::AxNumber && call->function != FunctionKind::Adp;
  const auto *operation = asInside<BinaryOperation>(tree, id);
  return literalValue(tree, id).has_value() || (operation && !isRelation(operation->op) && !isBitwise(operation->op));
}

void check(ExpressionId id, BlockId, const FileContext &context, const Reporter &reporter) {
  const auto *operation = as<BinaryOperation>(context.tree, id);
  if (!operation || (operation->op != OperatorKind::Equal && operation->op != OperatorKind::NotEqual))
    return;
  const bool vacantLeft = isVacant(context, operation->left);
  const ExpressionId vacant = vacantLeft ? operation->left : operation->right;
  const ExpressionId other = vacantLeft ? operation->right : operation->left;
  if (!isVacant(context, vacant) || !isNeverVacant(context.tree, other))
    return;
  const Span span = context.tree.expressions[other].span;
  reporter.report({.message = fmt::format("{} is never vacant", context.quoted(span)),
                   .span = context.tree.expressions[id].span,
                   .notes = {operation->op == OperatorKind::Equal ? "this comparison is never true"
                                                                  : "this comparison is always true",
                             "test each variable by itself, or compare with `0`"}});
}

} // namespace

extern const Rule equalityWithVacantArithmetic;
const Rule equalityWithVacantArithmetic{
    .info = {"equality-with-vacant-arithmetic", Category::Expression, Severity::Warning,
             "Reports a computed value or a number that is compared with `#0`: it is never vacant."},
    .hooks = {.expression = check, .expressionNodes = nodeSet<BinaryOperation>()}};

} // namespace feedhold::rules::equality_with_vacant_arithmetic
