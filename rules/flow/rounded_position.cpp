// rounded-position: `IF[#5003NE[#23-#13/3]]`.
#include "rules/flow/definitions.h"
#include "rules/flow/system_variables.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace feedhold::rules::rounded_position {
namespace {

bool rounds(FunctionKind function) {
  return function == FunctionKind::Round || function == FunctionKind::Fix || function == FunctionKind::Fup;
}

/// `#7/2`, `#7/10`: as few digits as the dimensions of drawings, or one more.
bool isShortDivisor(const SyntaxTree &tree, ExpressionId divisor) {
  const auto value = literalValue(tree, divisor);
  constexpr std::array kShort = {2, 4, 5, 10, 100, 1000, 10000};
  return value && std::ranges::any_of(kShort, [&](int each) { return *value == Decimal(each, 0); });
}

/// A quotient, a root or an angle function of variables: any number of digits, none of which is rounded away.
bool hasManyDigits(const SyntaxTree &tree, ExpressionId root) {
  const auto all = subexpressions(tree, root);
  const auto isRounding = [&](ExpressionId id) {
    const auto *call = as<FunctionCall>(tree, id);
    return call && rounds(call->function);
  };
  if (isConstant(tree, root) || std::ranges::any_of(all, isRounding))
    return false;
  return std::ranges::any_of(all, [&](ExpressionId id) {
    const auto *call = as<FunctionCall>(tree, id);
    const auto *operation = as<BinaryOperation>(tree, id);
    return (call && call->function != FunctionKind::Abs && !isConstant(tree, id)) ||
           (operation && operation->op == OperatorKind::Divide && !isConstant(tree, id) &&
            !isShortDivisor(tree, operation->right));
  });
}

/// The expression, or the only assignment behind its variable.
std::optional<Span> computedIn(const FlowFacts &facts, ExpressionId id, NodeId at) {
  const SyntaxTree &tree = *facts.file.tree;
  if (hasManyDigits(tree, id))
    return tree.expressions[id].span;
  const auto variable = variableOf(facts, id);
  const auto known = variable ? definitionsOf(facts, *variable, at) : std::nullopt;
  if (!known || known->fromEntry || known->nodes.size() != 1)
    return std::nullopt;
  const auto assignment = assignmentTo(facts, known->nodes.front(), *variable);
  return assignment && hasManyDigits(tree, assignment->value) ? std::optional(tree.expressions[assignment->value].span)
                                                              : std::nullopt;
}

void checkRelation(ExpressionId id, NodeId test, const FlowFacts &facts, const FileContext &context,
                   const Reporter &reporter) {
  const auto *relation = as<BinaryOperation>(context.tree, id);
  if (!relation || (relation->op != OperatorKind::Equal && relation->op != OperatorKind::NotEqual))
    return;
  for (const auto &[position, other] :
       {std::pair{relation->left, relation->right}, std::pair{relation->right, relation->left}}) {
    const auto number = variableOf(facts, position);
    const auto computed =
        number && isPosition(roleOf(context, *number)) ? computedIn(facts, other, test) : std::nullopt;
    if (!computed)
      continue;
    const Span span = context.tree.expressions[id].span;
    Diagnostic diagnostic{.message =
                              fmt::format("{} compares a position with {}, which has more digits than a position",
                                          context.quoted(span), context.quoted(*computed)),
                          .span = span,
                          .notes = {"a position is a multiple of the least input increment; the computed number seldom "
                                    "is, so the two differ where they are meant to be equal",
                                    "compare with a margin, as in `ABS[..] LT 0.001`"}};
    if (!span.contains(*computed))
      diagnostic.labels.push_back({*computed, "computed here"});
    reporter.report(std::move(diagnostic));
    return;
  }
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  // LinuxCNC: positions are not rounded.
  if (isTooLarge(facts) || context.dialect.grammar.oWords)
    return;
  const auto uses = context.model.variablesOf(facts.program);
  if (std::ranges::none_of(
          uses, [&](const VariableUse &use) { return use.number && isPosition(roleOf(context, *use.number)); }))
    return;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    if (!test || !test->condition || !facts.isReached(node))
      continue;
    for (const ExpressionId part : subexpressions(context.tree, *test->condition))
      checkRelation(part, node, facts, context, reporter);
  }
}

} // namespace

extern const Rule roundedPosition;
const Rule roundedPosition{.info = {"rounded-position", Category::Flow, Severity::Warning,
                                    "Reports `EQ` or `NE` of a position and a computed number that is not rounded."},
                           .hooks = {.flow = check}};

} // namespace feedhold::rules::rounded_position
