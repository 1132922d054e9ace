// sum-of-positions: `#3=[#1+#2]` and `X#3`, where both are positions on X: half of the sum was meant.
#include "rules/flow/definitions.h"
#include "rules/motion/motion_view.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace feedhold::rules::sum_of_positions {
namespace {

constexpr int kMostCopies = 4;

bool isPosition(const FileContext &context, std::uint32_t variable) {
  const VariableRange *range = variable >= kFirstNamedVariable ? nullptr : findVariable(context.dialect, variable);
  return range && (range->role == VariableRole::SkipPosition || range->role == VariableRole::WorkPosition ||
                   range->role == VariableRole::BlockEndPosition);
}

/// The only assignment from which the variable can have its value at the node.
std::optional<std::pair<NodeId, Assignment>> onlyAssignment(const FlowFacts &facts, std::uint32_t variable,
                                                            NodeId node) {
  const auto known = definitionsOf(facts, variable, node);
  if (!known || known->fromEntry || known->nodes.size() != 1)
    return std::nullopt;
  const auto assignment = assignmentTo(facts, known->nodes.front(), variable);
  return assignment ? std::optional(std::pair(known->nodes.front(), *assignment)) : std::nullopt;
}

/// The system variable that an expression copies.
std::optional<std::uint32_t> positionBehind(const FlowFacts &facts, const FileContext &context, ExpressionId id,
                                            NodeId node, int copies = 0) {
  const auto variable = variableOf(facts, unwrapped(context.tree, id));
  if (!variable || isPosition(context, *variable))
    return variable;
  const auto from = copies < kMostCopies ? onlyAssignment(facts, *variable, node) : std::nullopt;
  return from ? positionBehind(facts, context, from->second.value, from->first, copies + 1) : std::nullopt;
}

/// `#1+#2` of two positions on the same axis.
std::optional<ExpressionId> sumBehind(const FlowFacts &facts, const FileContext &context, ExpressionId id,
                                      NodeId node) {
  const auto *sum = asInside<BinaryOperation>(context.tree, id);
  if (sum && sum->op == OperatorKind::Add) {
    const auto left = positionBehind(facts, context, sum->left, node);
    const auto right = left ? positionBehind(facts, context, sum->right, node) : std::nullopt;
    return right && left == right ? std::optional(unwrapped(context.tree, id)) : std::nullopt;
  }
  const auto variable = variableOf(facts, unwrapped(context.tree, id));
  const auto from = variable ? onlyAssignment(facts, *variable, node) : std::nullopt;
  const auto *value = from ? asInside<BinaryOperation>(context.tree, from->second.value) : nullptr;
  return value ? sumBehind(facts, context, from->second.value, from->first) : std::nullopt;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts))
    return;
  const MotionView view(facts.program, context);
  std::set<ExpressionId> told;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    if (!facts.isReached(node))
      continue;
    for (const Word *word : view.axisWords(node)) {
      if (word->form() != WordForm::Expression)
        continue;
      const auto sum = sumBehind(facts, context, word->expression(), node);
      if (!sum || !told.insert(*sum).second)
        continue;
      const Span span = context.tree.expressions[*sum].span;
      Diagnostic diagnostic{
          .message = fmt::format("{} moves to the sum of two positions", context.quoted(word->span())),
          .span = word->span(),
          .notes = {"the middle between two positions is half of their sum: this point is twice as far from zero",
                    fmt::format("write `[{}]/2`", context.text(span))}};
      if (!word->span().contains(span))
        diagnostic.labels = {{span, "added here"}};
      reporter.report(std::move(diagnostic));
    }
  }
}

} // namespace

extern const Rule sumOfPositions;
const Rule sumOfPositions{.info = {"sum-of-positions", Category::Motion, Severity::Warning,
                                   "Reports a move to the sum of two positions on one axis that is not halved."},
                          .hooks = {.flow = check}};

} // namespace feedhold::rules::sum_of_positions
