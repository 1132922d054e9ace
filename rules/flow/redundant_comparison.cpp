// redundant-comparison: `[#1GE#2]OR[#1EQ#2]`: one of the two says nothing.
#include "rules/flow/relation_outcomes.h"

#include <fmt/format.h>

namespace feedhold::rules::redundant_comparison {
namespace {

void check(ExpressionId id, BlockId, const FileContext &context, const Reporter &reporter) {
  const SyntaxTree &tree = context.tree;
  const auto *both = as<BinaryOperation>(tree, id);
  if (!both || (both->op != OperatorKind::Or && both->op != OperatorKind::And))
    return;
  const BinaryOperation *left = relationIn(tree, both->left);
  const BinaryOperation *right = relationIn(tree, both->right);
  const auto outcomes = left && right ? outcomesOfBoth(context, *left, *right) : std::nullopt;
  if (!outcomes || readsLiveValue(context, left->left) || readsLiveValue(context, left->right))
    return;
  const auto [first, second] = *outcomes;
  const bool isOr = both->op == OperatorKind::Or;
  // In an OR the narrower one adds nothing, in an AND the wider one.
  const bool secondIsImplied = isOr ? (second & ~first) == 0 : (first & ~second) == 0;
  const bool firstIsImplied = isOr ? (first & ~second) == 0 : (second & ~first) == 0;
  if (!firstIsImplied && !secondIsImplied)
    return;
  const Span redundant = tree.expressions[secondIsImplied ? both->right : both->left].span;
  const Span other = tree.expressions[secondIsImplied ? both->left : both->right].span;
  reporter.report(
      {.message = fmt::format("{} has no effect beside {}", context.quoted(redundant), context.quoted(other)),
       .span = redundant,
       .labels = {{other, isOr ? "true whenever the other one is" : "true only when the other one is"}},
       .notes = {"probably another comparison or another variable was meant"}});
}

} // namespace

extern const Rule redundantComparison;
const Rule redundantComparison{.info = {"redundant-comparison", Category::Flow, Severity::Info,
                                        "Reports one of two joined comparisons that has no effect beside the other."},
                               .hooks = {.expression = check, .expressionNodes = nodeSet<BinaryOperation>()}};

} // namespace feedhold::rules::redundant_comparison
