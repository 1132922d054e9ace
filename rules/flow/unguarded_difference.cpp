// unguarded-difference: `#691/#692` with `#692=#603-#601`, which is 0 where both are equal.
#include "rules/flow/definitions.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::unguarded_difference {
namespace {

bool readsVariable(const SyntaxTree &tree, ExpressionId root) {
  return std::ranges::any_of(subexpressions(tree, root), [&](ExpressionId part) {
    return as<NumberedVariable>(tree, part) || as<IndirectVariable>(tree, part) || as<NamedVariable>(tree, part);
  });
}

/// `#603-#601`
bool isDifference(const SyntaxTree &tree, ExpressionId id) {
  const auto *difference = asInside<BinaryOperation>(tree, id);
  return difference && difference->op == OperatorKind::Subtract && readsVariable(tree, difference->left) &&
         readsVariable(tree, difference->right);
}

/// The divisor without the functions that keep a 0.
ExpressionId withoutAbs(const SyntaxTree &tree, ExpressionId id) {
  const ExpressionId inner = unwrapped(tree, id);
  const auto *call = as<FunctionCall>(tree, inner);
  return call && call->function == FunctionKind::Abs && !call->arguments().empty()
             ? withoutAbs(tree, call->arguments().front())
             : inner;
}

/// Some condition before the place asks for one of the variables.
bool isAsked(const FlowFacts &facts, NodeId at, ExpressionId difference, std::optional<std::uint32_t> variable) {
  const auto parts = readsIn(facts.file, difference, facts.node(at).block);
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    if (!test || !test->condition || !facts.isReached(node) || !findPath(facts, node, at, [](NodeId) { return false; }))
      continue;
    for (const Read &read : readsIn(facts.file, *test->condition, facts.node(node).block))
      if (!read.number || read.number == variable ||
          std::ranges::find(parts, read.number, &Read::number) != parts.end())
        return true;
  }
  return false;
}

constexpr int kMostCopies = 4;

/// The difference that makes the expression 0 where it is 0: itself, a factor, or behind a variable.
std::optional<ExpressionId> differenceBehind(const FlowFacts &facts, NodeId node, ExpressionId divisor,
                                             int copies = 0) {
  const SyntaxTree &tree = *facts.file.tree;
  const ExpressionId inner = withoutAbs(tree, divisor);
  if (isDifference(tree, inner))
    return inner;
  if (const auto *product = as<BinaryOperation>(tree, inner)) {
    if (product->op != OperatorKind::Multiply && product->op != OperatorKind::Divide)
      return std::nullopt;
    if (const auto left = differenceBehind(facts, node, product->left, copies))
      return left;
    return product->op == OperatorKind::Multiply ? differenceBehind(facts, node, product->right, copies) : std::nullopt;
  }
  const auto variable = copies < kMostCopies ? variableOf(facts, inner) : std::nullopt;
  const auto known = variable ? definitionsOf(facts, *variable, node) : std::nullopt;
  if (!known || known->fromEntry || known->nodes.size() != 1)
    return std::nullopt;
  const auto assignment = assignmentTo(facts, known->nodes.front(), *variable);
  return assignment ? differenceBehind(facts, known->nodes.front(), assignment->value, copies + 1) : std::nullopt;
}

/// `IF[#3-#2EQ0]`: the program knows that two of its values may be equal.
bool guardsDifferences(const FlowFacts &facts) {
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    const auto *relation =
        test && test->condition ? asInside<BinaryOperation>(*facts.file.tree, *test->condition) : nullptr;
    const auto zero = relation ? literalValue(*facts.file.tree, relation->right) : std::nullopt;
    if (zero && zero->isZero() && isDifference(*facts.file.tree, withoutAbs(*facts.file.tree, relation->left)))
      return true;
  }
  return false;
}

/// `ATAN[#1/[#2-#3]]`: of a line along an axis the difference is 0, and there its angle is as good as any.
bool isSlope(const FileContext &context, const FlowFacts &facts, NodeId node, ExpressionId divisor) {
  const auto all = expressionsOf(facts.file, facts.node(node).block);
  return std::ranges::any_of(all, [&](ExpressionId id) {
    const auto *call = as<FunctionCall>(context.tree, id);
    const bool isOne = call && call->function == FunctionKind::Atan && call->arguments().size() == 1;
    const auto *quotient = isOne ? asInside<BinaryOperation>(context.tree, call->arguments().front()) : nullptr;
    return quotient && quotient->op == OperatorKind::Divide && quotient->right == divisor;
  });
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts))
    return;
  for (const AlarmFact &alarm : facts.alarms()) {
    if (alarm.kind != AlarmKind::DivideByZero || alarm.always)
      continue;
    const auto place = expressionAt(facts, facts.node(alarm.node).block, alarm.place);
    if (!place)
      continue;
    const ExpressionId divisor = withoutAbs(context.tree, *place);
    const auto difference = differenceBehind(facts, alarm.node, divisor);
    if (!difference || isAsked(facts, alarm.node, *difference, variableOf(facts, divisor)))
      continue;
    Diagnostic diagnostic{
        .message = fmt::format("{} is 0 where the two values are equal: nothing checks it before this "
                               "division",
                               context.quoted(context.tree.expressions[*difference].span)),
        .span = alarm.place,
        .label = "divides by it",
        .notes = {fmt::format("the control then {}", stopsWith(context.dialect, AlarmKind::DivideByZero)),
                  "test the difference for 0 first; for an angle, write `ATAN[..]/[..]`, which takes "
                  "a divisor of 0"}};
    if (!alarm.place.contains(context.tree.expressions[*difference].span))
      diagnostic.labels.push_back({context.tree.expressions[*difference].span, "computed here"});
    reporter.report(std::move(diagnostic), isSlope(context, facts, alarm.node, *place) || guardsDifferences(facts)
                                               ? Severity::Warning
                                               : Severity::Info);
  }
}

} // namespace

extern const Rule unguardedDifference;
const Rule unguardedDifference{.info = {"unguarded-difference", Category::Flow, Severity::Warning,
                                        "Reports a division by a difference that is never checked for 0."},
                               .hooks = {.flow = check}};

} // namespace feedhold::rules::unguarded_difference
