// chained-comparison: `1LT#1LT5`, and `#1EQ1AND#2EQ2`, which is `#1EQ[1AND#2]EQ2`.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

namespace feedhold::rules::chained_comparison {
namespace {

const BinaryOperation *bareRelation(const SyntaxTree &tree, ExpressionId id) {
  const auto *operation = as<BinaryOperation>(tree, id);
  return operation && isRelation(operation->op) ? operation : nullptr;
}

void check(ExpressionId id, BlockId, const FileContext &context, const Reporter &reporter) {
  const BinaryOperation *outer = bareRelation(context.tree, id);
  const BinaryOperation *inner = outer ? bareRelation(context.tree, outer->left) : nullptr;
  if (!inner)
    return;
  reporter.report({.message = "each comparison needs its own brackets",
                   .span = context.tree.expressions[id].span,
                   .labels = {{inner->opSpan, "compared first"}, {outer->opSpan, "its result is compared again"}},
                   .notes = {"`AND` and `OR` bind tighter than a comparison; write `[#1 EQ 1] AND [#2 EQ 2]`"}});
}

} // namespace

extern const Rule chainedComparison;
const Rule chainedComparison{.info = {"chained-comparison", Category::Expression, Severity::Error,
                                      "Reports two comparisons joined without brackets, as in `#1 EQ 1 AND #2 EQ 2`."},
                             .hooks = {.expression = check, .expressionNodes = nodeSet<BinaryOperation>()}};

} // namespace feedhold::rules::chained_comparison
