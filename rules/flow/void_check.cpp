// Reasons: a vacancy that arithmetic or a default has removed, a sign that ABS has removed, an alarm that earlier
// checks leave no case.
#include "rules/flow/void_check.h"

#include "rules/flow/definitions.h"
#include "rules/flow/loop_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules {
namespace {

class VoidCheck {
public:
  VoidCheck(const FlowFacts &facts, const FileContext &context, NodeId test, ExpressionId condition)
      : facts_(facts), context_(context), tree_(context.tree), test_(test), condition_(condition) {}

  std::optional<VoidReason> reason() const {
    const auto *relation = asInside<BinaryOperation>(tree_, condition_);
    if (!relation || !isRelation(relation->op))
      return std::nullopt;
    for (const auto &[side, other] :
         {std::pair{relation->left, relation->right}, std::pair{relation->right, relation->left}}) {
      const bool asksVacancy = isEquality(relation->op) && isVacant(context_, other);
      if (auto found = asksVacancy ? neverVacant(side) : neverNegative(side, other))
        return found;
    }
    return alarmWithoutCase();
  }

  std::optional<VoidReason> deadBlocks(Truth truth) const {
    const auto jumps = context_.model.jumpsIn(block(), block().next());
    if (jumps.size() != 1 || jumps.front().kind != JumpKind::Goto || holdsConstant())
      return std::nullopt;
    const auto dead = truth == Truth::True ? std::optional(blockNext()) : blockBehind(facts_, jumps.front());
    if (!dead || reachedNode(facts_, *dead))
      return std::nullopt;
    return VoidReason{isAskedBefore() ? "the checks before it leave no case to these blocks: change their order, or "
                                        "correct the limit"
                                      : "what is computed before it leaves no other outcome: check the limit",
                      Label{tree_.blocks[*dead].span(), "never executed"}};
  }

private:
  /// Some variable of the condition has one value only: a setting decides.
  bool holdsConstant() const {
    const auto reads = readsIn(facts_.file, condition_, block());
    return std::ranges::any_of(reads, [&](const Read &read) {
      const AbstractValue *value = facts_.valueOf(read.expression);
      const bool isVacantConstant = read.number == kVacantVariable;
      return !isVacantConstant && (!value || (value->isNumber() && value->number().isConstant()));
    });
  }
  BlockId blockNext() const {
    NodeId node = facts_.node(test_).next;
    while (isLoneNumber(facts_, node))
      node = node.next();
    return facts_.node(node).block;
  }
  static bool isEquality(OperatorKind op) { return op == OperatorKind::Equal || op == OperatorKind::NotEqual; }

  /// `#101=#3*2`, then `IF[#101EQ#0]`: an operation or a function always gives a number.
  std::optional<VoidReason> neverVacant(ExpressionId side) const {
    const auto variable = variableOf(facts_, side);
    const auto known = variable ? definitionsOf(facts_, *variable, test_) : std::nullopt;
    if (!known || known->nodes.empty())
      return std::nullopt;
    if (known->fromEntry)
      return defaultBefore(*known, *variable);
    const bool areComputed = std::ranges::all_of(known->nodes, [&](NodeId node) {
      const auto assignment = assignmentTo(facts_, node, *variable);
      return assignment && isComputed(assignment->value);
    });
    if (!areComputed)
      return std::nullopt;
    return VoidReason{fmt::format("{} is computed before the check, and a result is a number: never vacant; check the "
                                  "variables that it is computed from",
                                  context_.quoted(spanOf(side))),
                      Label{valueSpan(known->nodes.front(), *variable), "always a number"}};
  }

  bool isComputed(ExpressionId value) const {
    const auto *operation = asInside<BinaryOperation>(tree_, value);
    const bool isCalculation = operation && !isRelation(operation->op);
    return (isCalculation || asInside<FunctionCall>(tree_, value)) && !isConstant(tree_, value);
  }

  /// `IF[#1EQ#0]THEN#1=2.` before it.
  std::optional<VoidReason> defaultBefore(const Definitions &known, std::uint32_t variable) const {
    const auto asks = [&](NodeId node) {
      const BlockId block = facts_.node(node).block;
      const auto reads = readsOf(facts_.file, block);
      return std::ranges::any_of(
          reads, [&](const Read &read) { return read.number == variable && read.use == ReadUse::Equality; });
    };
    if (known.nodes.size() != 1 || !asks(known.nodes.front()) || !isLocal(facts_.file, variable))
      return std::nullopt;
    return VoidReason{"where it is vacant, an earlier block has given it a value; the check comes too late, or the "
                      "default is one too many",
                      Label{valueSpan(known.nodes.front(), variable), "the default"}};
  }

  /// `IF[#101LT0]` behind `#101=ABS[#26]`.
  std::optional<VoidReason> neverNegative(ExpressionId side, ExpressionId other) const {
    const auto limit = literalValue(tree_, other);
    if (!limit || *limit > Decimal(0, 0))
      return std::nullopt;
    if (isNotNegative(side))
      return VoidReason{fmt::format("{} is never negative", context_.quoted(spanOf(side))), std::nullopt};
    const auto variable = variableOf(facts_, side);
    const auto known = variable ? definitionsOf(facts_, *variable, test_) : std::nullopt;
    if (!known || known->fromEntry || known->nodes.size() != 1)
      return std::nullopt;
    const auto assignment = assignmentTo(facts_, known->nodes.front(), *variable);
    if (!assignment || !isNotNegative(assignment->value))
      return std::nullopt;
    return VoidReason{fmt::format("{} is the result of {}, which is never negative; check the sign before that block",
                                  context_.quoted(spanOf(side)), context_.quoted(spanOf(assignment->value))),
                      Label{spanOf(assignment->value), "never negative"}};
  }

  bool isNotNegative(ExpressionId value) const {
    const auto *call = asInside<FunctionCall>(tree_, value);
    return call && (call->function == FunctionKind::Abs || call->function == FunctionKind::Sqrt);
  }

  /// Its alarm is raised by no run: the checks before it send every case elsewhere.
  std::optional<VoidReason> alarmWithoutCase() const {
    const auto jumps = context_.model.jumpsIn(block(), block().next());
    if (jumps.size() != 1)
      return std::nullopt;
    const auto alarm = blockBehind(facts_, jumps.front());
    if (!alarm || reachedNode(facts_, *alarm) || !isAskedBefore())
      return std::nullopt;
    return VoidReason{"the checks before it leave no case to it, so its alarm is never raised: change their order, or "
                      "correct the limit",
                      Label{tree_.blocks[*alarm].span(), "never executed"}};
  }

  /// A test before it reads one of its variables: not the values of a setting decide, but another check.
  bool isAskedBefore() const {
    const auto own = readsIn(facts_.file, condition_, block());
    return std::ranges::any_of(testsBefore(facts_, test_), [&](const PassedTest &passed) {
      const auto *earlier = std::get_if<Test>(&facts_.node(passed.node).instruction);
      const auto reads = readsIn(facts_.file, *earlier->condition, facts_.node(passed.node).block);
      return std::ranges::any_of(reads, [&](const Read &read) {
        return read.number && *read.number != kVacantVariable &&
               std::ranges::any_of(own, [&](const Read &mine) { return mine.number == read.number; });
      });
    });
  }

  BlockId block() const { return facts_.node(test_).block; }
  Span spanOf(ExpressionId id) const { return tree_.expressions[id].span; }
  Span valueSpan(NodeId node, std::uint32_t variable) const {
    return spanOf(assignmentTo(facts_, node, variable)->value);
  }

  const FlowFacts &facts_;
  const FileContext &context_;
  const SyntaxTree &tree_;
  NodeId test_;
  ExpressionId condition_;
};

} // namespace

std::optional<VoidReason> whyVoid(const FlowFacts &facts, const FileContext &context, NodeId test,
                                  ExpressionId condition) {
  return isTooLarge(facts) ? std::nullopt : VoidCheck(facts, context, test, condition).reason();
}

std::optional<VoidReason> whatNeverRuns(const FlowFacts &facts, const FileContext &context, NodeId test,
                                        ExpressionId condition, Truth truth) {
  return isTooLarge(facts) ? std::nullopt : VoidCheck(facts, context, test, condition).deadBlocks(truth);
}

} // namespace feedhold::rules
