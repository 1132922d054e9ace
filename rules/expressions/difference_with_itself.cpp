// difference-with-itself: `#26-#26`.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include <fmt/format.h>

namespace feedhold::rules::difference_with_itself {
namespace {

void check(ExpressionId id, BlockId, const FileContext &context, const Reporter &reporter) {
  const auto *operation = as<BinaryOperation>(context.tree, id);
  if (!operation || (operation->op != OperatorKind::Subtract && operation->op != OperatorKind::Divide))
    return;
  const Span left = context.tree.expressions[operation->left].span;
  const Span right = context.tree.expressions[operation->right].span;
  if (!sameText(context, left, right) || isConstant(context.tree, operation->left))
    return;
  const bool subtracts = operation->op == OperatorKind::Subtract;
  reporter.report({.message = fmt::format("{} is always {}", context.quoted(cover(left, right)), subtracts ? "0" : "1"),
                   .span = cover(left, right),
                   .notes = {"probably one of the two should be another variable"}});
}

} // namespace

extern const Rule differenceWithItself;
const Rule differenceWithItself{.info = {"difference-with-itself", Category::Expression, Severity::Warning,
                                         "Reports a value that is subtracted from itself or divided by itself."},
                                .hooks = {.expression = check, .expressionNodes = nodeSet<BinaryOperation>()}};

} // namespace feedhold::rules::difference_with_itself
