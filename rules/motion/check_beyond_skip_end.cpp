// check-beyond-skip-end: `G31 Z-50.`, and then `IF[#5063LT-50.]GOTO90`: the move ends at Z-50. at the latest.
#include "rules/flow/definitions.h"
#include "rules/flow/system_variables.h"
#include "rules/motion/touch_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace feedhold::rules::check_beyond_skip_end {
namespace {

/// `#5063LT-50.`, the position on the left.
struct Comparison {
  bool isLess; // LT, LE
  bool isOrEqual;
  ExpressionId position;
  Decimal limit;
};

std::optional<Comparison> comparisonIn(const FileContext &context, ExpressionId condition) {
  const auto *relation = asInside<BinaryOperation>(context.tree, condition);
  if (!relation || !isRelation(relation->op) || relation->op == OperatorKind::Equal ||
      relation->op == OperatorKind::NotEqual)
    return std::nullopt;
  const bool isLess = relation->op == OperatorKind::LessThan || relation->op == OperatorKind::LessOrEqual;
  const bool isOrEqual = relation->op == OperatorKind::LessOrEqual || relation->op == OperatorKind::GreaterOrEqual;
  if (const auto limit = literalValue(context.tree, relation->right))
    return Comparison{isLess, isOrEqual, relation->left, *limit};
  if (const auto limit = literalValue(context.tree, relation->left))
    return Comparison{!isLess, isOrEqual, relation->right, *limit};
  return std::nullopt;
}

/// Where a skip move ends without a signal, and from which side it comes.
struct SkipEnd {
  NodeId skip;
  const Word *end;
  bool goesDown;
};

class Reader {
public:
  Reader(const FlowFacts &facts, const FileContext &context)
      : facts_(facts), context_(context), view_(facts.program, context) {}

  bool isIncremental() const {
    for (NodeId node = facts_.entry(); node < facts_.end(); node = node.next())
      if (view_.mayDo(node, {CodeAction::Incremental}) && view_.findAction(node, {CodeAction::Incremental}))
        return true;
    return false;
  }
  /// Of the move from which the position is.
  std::optional<SkipEnd> endOf(ExpressionId position, NodeId at) const {
    const auto number = variableNumber(context_.tree, unwrapped(context_.tree, position));
    if (!number)
      return std::nullopt;
    if (roleOf(context_, *number) == VariableRole::SkipPosition)
      return endBefore(at, *number);
    const auto known = definitionsOf(facts_, *number, at);
    if (!known || known->fromEntry || known->nodes.size() != 1)
      return std::nullopt;
    const auto copy = assignmentTo(facts_, known->nodes.front(), *number);
    const auto from = copy ? variableNumber(context_.tree, unwrapped(context_.tree, copy->value)) : std::nullopt;
    return from && roleOf(context_, *from) == VariableRole::SkipPosition ? endBefore(known->nodes.front(), *from)
                                                                         : std::nullopt;
  }
  Span spanOf(NodeId node) const { return view_.blockSpan(node); }

private:
  const Word *wordOf(NodeId node, char axis) const {
    for (const Word *word : view_.axisWords(node))
      if (word->address() == axis)
        return word;
    return nullptr;
  }
  std::optional<SkipEnd> endBefore(NodeId node, std::uint32_t position) const {
    const auto axis = axisOfPosition(context_, position);
    const auto skip = axis ? skipBefore(facts_, view_, node) : std::nullopt;
    const Word *end = skip ? wordOf(*skip, *axis) : nullptr;
    const Word *start = end ? startBefore(*skip, *axis) : nullptr;
    if (!start || !start->isNumber() || !end->isNumber() || start->number() == end->number())
      return std::nullopt;
    return SkipEnd{*skip, end, end->number() < start->number()};
  }
  /// The word of the axis in the last movement before the skip move.
  const Word *startBefore(NodeId skip, char axis) const {
    constexpr int kFarthest = 12;
    auto at = onlyPredecessor(facts_, skip);
    for (int i = 0; at && i < kFarthest; ++i, at = onlyPredecessor(facts_, *at)) {
      const Word *word = wordOf(*at, axis);
      if (word || view_.findAction(*at, {CodeAction::ReferenceReturn, CodeAction::MachineMove, CodeAction::Skip,
                                         CodeAction::CoordinateSet, CodeAction::LocalShift, CodeAction::WorkOffset}))
        return word && !view_.modalMotionWords(*at).empty() ? word : nullptr;
    }
    return nullptr;
  }

  const FlowFacts &facts_;
  const FileContext &context_;
  MotionView view_;
};

/// What the condition always is for positions between the start and the end; absent where it depends.
std::optional<bool> outcomeOf(const Comparison &comparison, const SkipEnd &end) {
  const Decimal &last = end.end->number();
  const bool isAtEnd = comparison.limit == last;
  const bool isBeyond = end.goesDown ? comparison.limit < last : last < comparison.limit;
  const bool towardsEnd = comparison.isLess == end.goesDown; // asks for what lies beyond the limit
  if (isBeyond || (isAtEnd && comparison.isOrEqual != towardsEnd))
    return !towardsEnd;
  return std::nullopt;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts) || context.dialect.machine == MachineKind::Turning)
    return;
  const Reader reader(facts, context);
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    const auto comparison =
        test && test->condition && facts.isReached(node) ? comparisonIn(context, *test->condition) : std::nullopt;
    const auto end = comparison ? reader.endOf(comparison->position, node) : std::nullopt;
    const auto outcome = end ? outcomeOf(*comparison, *end) : std::nullopt;
    if (!outcome || reader.isIncremental())
      continue;
    const Span condition = context.tree.expressions[*test->condition].span;
    reporter.report(
        {.message = fmt::format("{} is always {}: the skip move ends at {} at the latest", context.quoted(condition),
                                *outcome ? "true" : "false", context.quoted(end->end->span())),
         .span = condition,
         .labels = {{reader.spanOf(end->skip), "the skip move"}},
         .notes = {"a probe that touches nothing is not noticed here: its position is then exactly the end point",
                   "compare with a point a little before the end"}});
  }
}

} // namespace

extern const Rule checkBeyondSkipEnd;
const Rule checkBeyondSkipEnd{.info = {"check-beyond-skip-end", Category::Motion, Severity::Warning,
                                       "Reports a check of a skip position that has the same outcome whether the probe "
                                       "touches or not."},
                              .hooks = {.flow = check}};

} // namespace feedhold::rules::check_beyond_skip_end
