// condition-without-relation: `IF[#1]` on a control that wants a comparison.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include <fmt/format.h>

namespace feedhold::rules::condition_without_relation {
namespace {

const BinaryOperation *joined(const SyntaxTree &tree, ExpressionId id) {
  const auto *operation = asInside<BinaryOperation>(tree, id);
  return operation && isBitwise(operation->op) ? operation : nullptr;
}

/// A comparison, or comparisons joined; what did not parse may be one.
bool compares(const SyntaxTree &tree, ExpressionId id) {
  if (asInside<BrokenExpression>(tree, id))
    return true;
  if (const auto *both = joined(tree, id))
    return compares(tree, both->left) || compares(tree, both->right);
  const auto *operation = asInside<BinaryOperation>(tree, id);
  return operation && isRelation(operation->op);
}

void reportParts(ExpressionId id, const FileContext &context, const Reporter &reporter) {
  if (!compares(context.tree, id)) {
    const Span span = context.tree.expressions[id].span;
    reporter.report({.message = fmt::format("{} is not a comparison", context.quoted(span)),
                     .span = span,
                     .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::ExpressionFormat)),
                               "a condition needs a comparison here, such as `#1 NE 0`"}});
    return;
  }
  if (const auto *both = joined(context.tree, id)) {
    reportParts(both->left, context, reporter);
    reportParts(both->right, context, reporter);
  }
}

void check(const Statement &statement, BlockId, const FileContext &context, const Reporter &reporter) {
  const auto condition = conditionOf(statement);
  if (condition && !context.dialect.grammar.conditionMayBeAnyValue)
    reportParts(*condition, context, reporter);
}

} // namespace

extern const Rule conditionWithoutRelation;
const Rule conditionWithoutRelation{.info = {"condition-without-relation", Category::Expression, Severity::Error,
                                             "Reports a condition, or a part of one, that is not a comparison."},
                                    .hooks = {.statement = check}};

} // namespace feedhold::rules::condition_without_relation
