// decided-condition: an IF that can have one outcome only, given what was decided or computed before it.
#include "findings/rule/dead_blocks.h"
#include "rules/flow/definitions.h"
#include "rules/flow/loop_view.h"
#include "rules/flow/void_check.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

namespace feedhold::rules::decided_condition {
namespace {

/// `#101EQ#0`: whether a variable is vacant is asked.
bool asksVacancy(const FileContext &context, ExpressionId condition) {
  const auto *relation = asInside<BinaryOperation>(context.tree, condition);
  return relation && (isVacant(context, relation->left) || isVacant(context, relation->right));
}

/// It should raise an alarm, and never does, for a reason that shows a mistake.
std::optional<VoidReason> voidReason(const FlowFacts &facts, const FileContext &context, NodeId node,
                                     ExpressionId condition, Truth truth) {
  const auto alarm = alarmWhenTrue(facts, node);
  return alarm && *alarm == (truth == Truth::False) ? whyVoid(facts, context, node, condition) : std::nullopt;
}

void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter, NodeId node,
            ExpressionId condition, Truth truth, std::optional<VoidReason> reason, std::string_view effect) {
  const Span span = context.tree.expressions[condition].span;
  Diagnostic diagnostic{.message = fmt::format("{} {} here{}", context.quoted(span),
                                               truth == Truth::True ? "is always true" : "is never true", effect),
                        .span = span,
                        .flow = pathFromEntry(facts, node)};
  if (reason) {
    if (reason->label)
      diagnostic.labels.push_back(std::move(*reason->label));
    diagnostic.notes.push_back(std::move(reason->note));
  } else {
    diagnostic.notes.emplace_back(asksVacancy(context, condition) && truth == Truth::False
                                      ? "it has been set before, so it holds a number and is not vacant"
                                      : "the blocks before it leave no other outcome");
  }
  reporter.report(std::move(diagnostic), reason ? Severity::Warning : Severity::Info);
}

bool areOpposite(OperatorKind left, OperatorKind right) {
  using enum OperatorKind;
  constexpr std::array kOpposites = {std::pair{Equal, NotEqual}, std::pair{LessThan, GreaterOrEqual},
                                     std::pair{GreaterThan, LessOrEqual}};
  return std::ranges::any_of(kOpposites, [&](const auto &pair) {
    return (pair.first == left && pair.second == right) || (pair.second == left && pair.first == right);
  });
}

/// `IF[#7EQ1]GOTO20` directly above `IF[#7NE1]GOTO30`.
std::optional<ExpressionId> oppositeAbove(const FlowFacts &facts, const FileContext &context, NodeId node) {
  const auto conditionAt = [&](NodeId at) {
    const auto *test = std::get_if<Test>(&facts.node(at).instruction);
    const auto jumps = context.model.jumpsIn(facts.node(at).block, facts.node(at).block.next());
    const bool isJump = jumps.size() == 1 && jumps.front().kind == JumpKind::Goto;
    return test && isJump ? test->condition : std::nullopt;
  };
  const auto above = onlyPredecessor(facts, node);
  const auto first = above && facts.node(*above).next == node ? conditionAt(*above) : std::nullopt;
  const auto second = conditionAt(node);
  const auto *left = first ? asInside<BinaryOperation>(context.tree, *first) : nullptr;
  const auto *right = second ? asInside<BinaryOperation>(context.tree, *second) : nullptr;
  if (!left || !right || !areOpposite(left->op, right->op) || readsLiveValue(context, *first))
    return std::nullopt;
  const auto spanOf = [&](ExpressionId id) { return context.tree.expressions[unwrapped(context.tree, id)].span; };
  return sameText(context, spanOf(left->left), spanOf(right->left)) &&
                 sameText(context, spanOf(left->right), spanOf(right->right))
             ? first
             : std::nullopt;
}

/// Two opposite conditions, both with a jump, and blocks behind them that nothing else leads to.
void checkOpposites(const FlowFacts &facts, const FileContext &context, NodeId node, const Reporter &reporter) {
  const auto above = oppositeAbove(facts, context, node);
  const NodeId behind = facts.node(node).next;
  if (!above || !facts.isReached(behind) || onlyPredecessor(facts, behind) != node ||
      findWord(context.tree, facts.node(behind).block, 'N') || !hasContent(context, facts.node(behind).block))
    return;
  const BlockId dead = facts.node(behind).block;
  const Span span = context.tree.expressions[*std::get<Test>(facts.node(node).instruction).condition].span;
  reporter.report({.message = fmt::format("{} is always true here: blocks behind it never run", context.quoted(span)),
                   .span = span,
                   .labels = {{context.tree.expressions[*above].span, "jumps in all other cases"},
                              {context.tree.blocks[dead].span(), "never executed"}},
                   .notes = {"the two conditions are opposite: one of the jumps is always taken",
                             "correct the second condition, or delete it or the blocks behind it"}},
                  raisesAlarmAt(facts.file, dead) ? Severity::Info : Severity::Warning);
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    if (facts.isReached(node) && std::holds_alternative<Test>(facts.node(node).instruction) &&
        facts.truthOf(node) == Truth::Maybe)
      checkOpposites(facts, context, node, reporter);
  if (isMainProgram(facts))
    return; // settings at its head are asked on purpose
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    const auto truth = test && test->condition ? facts.truthOf(node) : std::nullopt;
    if (!truth || *truth == Truth::Maybe || isConstant(context.tree, *test->condition))
      continue;
    const BlockId block = facts.node(node).block;
    const auto statements = context.tree.statementsOf(block);
    const bool isWhile =
        std::ranges::any_of(statements, [](const Statement &s) { return std::holds_alternative<While>(s.node); });
    auto reason = isWhile ? std::nullopt : voidReason(facts, context, node, *test->condition, *truth);
    const bool toBeSure =
        isAskedToBeSure(facts, *test->condition, block) && !(reason && asksVacancy(context, *test->condition));
    if (isWhile || toBeSure)
      continue;
    if (reason) // an alarm
      report(facts, context, reporter, node, *test->condition, *truth, reason, ": this check cannot raise its alarm");
    else if (reason = whatNeverRuns(facts, context, node, *test->condition, *truth); reason)
      report(facts, context, reporter, node, *test->condition, *truth, reason, ": blocks behind it never run");
    else
      report(facts, context, reporter, node, *test->condition, *truth, reason, "");
  }
}

} // namespace

extern const Rule decidedCondition;
const Rule decidedCondition{.info = {"decided-condition", Category::Flow, Severity::Warning,
                                     "Reports a condition that always has the same outcome."},
                            .hooks = {.flow = check, .flowRuns = FlowRuns::All}};

} // namespace feedhold::rules::decided_condition
