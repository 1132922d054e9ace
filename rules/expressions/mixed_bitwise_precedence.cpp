// mixed-bitwise-precedence: `#1+#2AND7` is `#1+[#2AND7]`.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include <fmt/format.h>

namespace feedhold::rules::mixed_bitwise_precedence {
namespace {

/// The operator of an operand that is written without brackets around it.
const BinaryOperation *bareBitwise(const SyntaxTree &tree, ExpressionId operand) {
  const auto *operation = as<BinaryOperation>(tree, operand);
  return operation && isBitwise(operation->op) ? operation : nullptr;
}

void check(ExpressionId id, BlockId, const FileContext &context, const Reporter &reporter) {
  const auto *outer = as<BinaryOperation>(context.tree, id);
  if (!outer || isBitwise(outer->op) || isRelation(outer->op))
    return;
  const bool onLeft = bareBitwise(context.tree, outer->left) != nullptr;
  const ExpressionId operand = onLeft ? outer->left : outer->right;
  const BinaryOperation *inner = bareBitwise(context.tree, operand);
  if (!inner)
    return;
  const Span group = context.tree.expressions[operand].span;
  reporter.report({.message = fmt::format("`{}` is computed before `{}`", spellingOf(inner->op), spellingOf(outer->op)),
                   .span = group,
                   .label = "computed first",
                   .labels = {{outer->opSpan, "computed second"}},
                   .notes = {"the control ranks `AND` with `*`, and `OR` and `XOR` with `+`, from left to right",
                             "brackets show which grouping is intended"},
                   .fixes = {{.title = "put brackets around what the control computes first",
                              .edits = {{{group.begin, group.begin}, "["}, {{group.end, group.end}, "]"}}}}});
}

} // namespace

extern const Rule mixedBitwisePrecedence;
const Rule mixedBitwisePrecedence{.info = {"mixed-bitwise-precedence", Category::Expression, Severity::Warning,
                                           "Reports `AND`, `OR` or `XOR` next to `+ - * /` without brackets, where the "
                                           "control groups them in an unexpected way."},
                                  .hooks = {.expression = check, .expressionNodes = nodeSet<BinaryOperation>()}};

} // namespace feedhold::rules::mixed_bitwise_precedence
