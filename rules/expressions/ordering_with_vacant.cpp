// ordering-with-vacant: `#1GT#0`.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include <fmt/format.h>

namespace feedhold::rules::ordering_with_vacant {
namespace {

bool isOrdering(OperatorKind op) { return isRelation(op) && op != OperatorKind::Equal && op != OperatorKind::NotEqual; }

void check(ExpressionId id, BlockId, const FileContext &context, const Reporter &reporter) {
  const auto *operation = as<BinaryOperation>(context.tree, id);
  if (!operation || !isOrdering(operation->op))
    return;
  const bool onLeft = isVacant(context, operation->left);
  if (!onLeft && !isVacant(context, operation->right))
    return;
  const Span vacant = context.tree.expressions[onLeft ? operation->left : operation->right].span;
  reporter.report({.message = fmt::format("`{}` reads {} as 0", spellingOf(operation->op), context.quoted(vacant)),
                   .span = context.tree.expressions[id].span,
                   .notes = {"only `EQ` and `NE` distinguish vacant from 0",
                             "write `0` to compare with zero, or use `EQ` or `NE` to test for vacant"},
                   .fixes = {{FixSafety::Safe, "write `0`", {{vacant, "0"}}}}});
}

} // namespace

extern const Rule orderingWithVacant;
const Rule orderingWithVacant{
    .info = {"ordering-with-vacant", Category::Expression, Severity::Info,
             "Reports `GT`, `GE`, `LT` or `LE` with `#0`: the control compares with 0 and does not test for vacant."},
    .hooks = {.expression = check, .expressionNodes = nodeSet<BinaryOperation>()}};

} // namespace feedhold::rules::ordering_with_vacant
