// exchanged-limits: `IF[#1GT#2-#3]GOTO90` and `IF[#1LT#2+#3]GOTO90`: every value jumps.
#include "rules/flow/relation_outcomes.h"
#include "rules/flow/straight_path.h"

#include <fmt/format.h>

namespace feedhold::rules::exchanged_limits {
namespace {

/// `#1 GT #2-#3`, the value on the left.
struct Limit {
  ExpressionId value;
  ExpressionId limit;
  bool isAbove; // the relation holds above the limit
  bool orEqual;
  Span span;
};

std::optional<Limit> limitIn(const FileContext &context, ExpressionId condition) {
  const BinaryOperation *relation = relationIn(context.tree, condition);
  if (!relation || relation->op == OperatorKind::Equal || relation->op == OperatorKind::NotEqual)
    return std::nullopt;
  const bool orEqual = relation->op == OperatorKind::GreaterOrEqual || relation->op == OperatorKind::LessOrEqual;
  const bool isAbove = relation->op == OperatorKind::GreaterThan || relation->op == OperatorKind::GreaterOrEqual;
  return Limit{relation->left, relation->right, isAbove, orEqual, context.tree.expressions[condition].span};
}

/// What the two comparisons do together.
enum class Together : std::uint8_t { Jump, Or, And };

struct Pair {
  Limit above; // holds above its limit
  Limit below;
  Together how;
};

std::optional<Pair> pairOf(const FileContext &context, const std::optional<Limit> &first,
                           const std::optional<Limit> &second, Together how) {
  if (!first || !second || first->isAbove == second->isAbove)
    return std::nullopt;
  const auto textOf = [&](ExpressionId id) { return context.tree.expressions[unwrapped(context.tree, id)].span; };
  if (!sameText(context, textOf(first->value), textOf(second->value)))
    return std::nullopt;
  return first->isAbove ? Pair{*first, *second, how} : Pair{*second, *first, how};
}

/// The condition of a node that jumps where it holds.
std::optional<ExpressionId> jumpCondition(const FlowFacts &facts, NodeId node, std::optional<BlockId> &target) {
  const auto *test = std::get_if<Test>(&facts.node(node).instruction);
  if (!test || !test->condition)
    return std::nullopt;
  const BlockId block = facts.node(node).block;
  const auto jumps = facts.file.model->jumpsIn(block, block.next());
  if (jumps.size() != 1 || jumps.front().kind != JumpKind::Goto || !jumps.front().target)
    return std::nullopt;
  target = jumps.front().target;
  return test->condition;
}

/// `IF[..]GOTO90`, and in the next block another one with the same target.
std::optional<Pair> pairOfJumps(const FlowFacts &facts, const FileContext &context, NodeId second) {
  const auto first = onlyPredecessor(facts, second);
  std::optional<BlockId> firstTarget;
  std::optional<BlockId> secondTarget;
  const auto firstCondition = first ? jumpCondition(facts, *first, firstTarget) : std::nullopt;
  const auto secondCondition = firstCondition ? jumpCondition(facts, second, secondTarget) : std::nullopt;
  if (!secondCondition || firstTarget != secondTarget)
    return std::nullopt;
  return pairOf(context, limitIn(context, *firstCondition), limitIn(context, *secondCondition), Together::Jump);
}

std::optional<Pair> pairInCondition(const FlowFacts &facts, const FileContext &context, NodeId node) {
  const auto *test = std::get_if<Test>(&facts.node(node).instruction);
  const auto *both = test && test->condition ? asInside<BinaryOperation>(context.tree, *test->condition) : nullptr;
  if (!both || (both->op != OperatorKind::Or && both->op != OperatorKind::And))
    return std::nullopt;
  return pairOf(context, limitIn(context, both->left), limitIn(context, both->right),
                both->op == OperatorKind::Or ? Together::Or : Together::And);
}

/// By how much the limit of `below` lies above that of `above`: a number, or a multiple of one tolerance.
struct Overlap {
  double amount;
  bool isOfTolerance;
};

std::optional<Overlap> overlapOf(const Pair &pair, const FlowFacts &facts, NodeId at) {
  StraightPath path(facts, at, [](NodeId) { return false; });
  const auto low = path.formOf(pair.above.limit, 0);
  const auto high = low ? path.formOf(pair.below.limit, 0) : std::nullopt;
  if (!high)
    return std::nullopt;
  const LinearForm difference = sum(*high, -1, *low);
  if (difference.isConstant())
    return Overlap{difference.constant, false};
  if (difference.constant != 0 || difference.factors.size() != 1)
    return std::nullopt;
  const auto &[number, factor] = *difference.factors.begin();
  const auto factorIn = [&number = number](const LinearForm &form) {
    const auto found = form.factors.find(number);
    return found == form.factors.end() ? 0.0 : found->second;
  };
  // Taken away from one limit and added to the other: a tolerance, which nobody makes negative.
  if (factorIn(*low) * factorIn(*high) >= 0)
    return std::nullopt;
  return Overlap{factor, true};
}

bool coversAll(const Pair &pair, const Overlap &overlap) {
  return overlap.amount > 0 || (overlap.amount == 0 && (pair.above.orEqual || pair.below.orEqual));
}

/// `LT #2-#3 AND GT #2+#3`.
bool leavesNothing(const Pair &pair, const Overlap &overlap) {
  return overlap.amount < 0 || (overlap.amount == 0 && !(pair.above.orEqual && pair.below.orEqual));
}

void tell(const Pair &pair, const Overlap &overlap, const Reporter &reporter) {
  const std::string_view when = overlap.isOfTolerance ? " with every tolerance above 0" : "";
  const bool isAboveSecond = pair.above.span.begin > pair.below.span.begin;
  const Limit &first = isAboveSecond ? pair.below : pair.above;
  const Limit &second = isAboveSecond ? pair.above : pair.below;
  std::string message;
  std::string consequence;
  switch (pair.how) {
  case Together::Jump:
    message = fmt::format("one of these two jumps is taken{}, whatever the value is", when);
    consequence = "nothing goes on to the block behind them";
    break;
  case Together::Or:
    message = fmt::format("one of the two limits holds{}, whatever the value is", when);
    consequence = "the condition is always true";
    break;
  case Together::And:
    message = fmt::format("no value lies on these sides of both limits{}", when);
    consequence = "the condition is never true";
    break;
  }
  reporter.report({.message = message,
                   .span = second.span,
                   .labels = {{first.span, "the other limit"}},
                   .notes = {consequence, "exchange GT and LT, or the two limits"}});
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts))
    return;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    if (!facts.isReached(node) || !std::holds_alternative<Test>(facts.node(node).instruction))
      continue;
    const auto inCondition = pairInCondition(facts, context, node);
    const auto pair = inCondition ? inCondition : pairOfJumps(facts, context, node);
    const auto overlap = pair ? overlapOf(*pair, facts, node) : std::nullopt;
    if (overlap && (pair->how == Together::And ? leavesNothing(*pair, *overlap) : coversAll(*pair, *overlap)))
      tell(*pair, *overlap, reporter);
  }
}

} // namespace

extern const Rule exchangedLimits;
const Rule exchangedLimits{.info = {"exchanged-limits", Category::Flow, Severity::Warning,
                                    "Reports two limits of one value of which one always holds, or never both."},
                           .hooks = {.flow = check}};

} // namespace feedhold::rules::exchanged_limits
