// decided-condition: an IF that can have one outcome only, given what was decided or computed before it.
#include "findings/rule/dead_blocks.h"
#include "rules/flow/definitions.h"
#include "rules/flow/loop_view.h"
#include "rules/flow/relation_outcomes.h"
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

constexpr unsigned kAllOutcomes = 7;

/// What a comparison comes to where another one has the outcome; absent where that leaves both.
std::optional<bool> outcomeGiven(const FileContext &context, ExpressionId known, bool isTrue, ExpressionId asked) {
  const BinaryOperation *first = relationIn(context.tree, known);
  const BinaryOperation *second = relationIn(context.tree, asked);
  const auto both = first && second ? outcomesOfBoth(context, *first, *second) : std::nullopt;
  if (!both)
    return std::nullopt;
  const unsigned left = isTrue ? both->first : kAllOutcomes & ~both->first;
  if ((left & both->second) == 0)
    return false;
  return (left & ~both->second) == 0 ? std::optional(true) : std::nullopt;
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
  return first && second && !readsLiveValue(context, *first) && outcomeGiven(context, *first, false, *second) == true
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

/// The test of a WHILE, and not that of an IF behind it in the block.
bool isWhile(const FlowFacts &facts, NodeId node) {
  const auto *test = std::get_if<Test>(&facts.node(node).instruction);
  return test && std::ranges::any_of(facts.file.tree->statementsOf(facts.node(node).block), [&](const Statement &s) {
           const auto *loop = std::get_if<While>(&s.node);
           return loop && loop->condition == test->condition;
         });
}

/// The node may change what an expression of plain variables comes to.
bool mayChange(const FlowFacts &facts, NodeId node, const std::vector<Read> &reads) {
  const Instruction &instruction = facts.node(node).instruction;
  if (std::holds_alternative<Havoc>(instruction) || std::holds_alternative<CallProgram>(instruction))
    return true;
  return std::ranges::any_of(assignmentsOf(facts, node), [&](const Assignment &assignment) {
    const auto target = variableOf(facts, assignment.target);
    return !target || std::ranges::any_of(reads, [&](const Read &read) { return read.number == target; });
  });
}

struct Decided {
  ExpressionId by;
  bool isTrue;
};

/// `WHILE[#1LE#2]DO1`, and in its first blocks `IF[#1GT#2]`: the test above, between which and here nothing changes.
std::optional<Decided> decidedAbove(const FlowFacts &facts, const FileContext &context, NodeId node,
                                    ExpressionId condition) {
  const std::vector<Read> reads = readsIn(facts.file, condition, facts.node(node).block);
  if (readsLiveValue(context, condition) ||
      !std::ranges::all_of(reads, [&](const Read &read) { return read.number && isPlain(facts.file, *read.number); }))
    return std::nullopt;
  NodeId at = node;
  for (auto above = onlyPredecessor(facts, at); above && !mayChange(facts, *above, reads);
       at = *above, above = onlyPredecessor(facts, at)) {
    const auto *test = std::get_if<Test>(&facts.node(*above).instruction);
    if (!test || !test->condition || test->taken == facts.node(*above).next || facts.truthOf(*above) != Truth::Maybe)
      continue; // settings at the head of a program decide some tests, on purpose
    if (const auto isTrue = outcomeGiven(context, *test->condition, test->taken == at, condition))
      return Decided{*test->condition, *isTrue};
  }
  return std::nullopt;
}

/// False: nothing to tell.
bool checkDecided(const FlowFacts &facts, const FileContext &context, NodeId node, const Reporter &reporter) {
  const auto *test = std::get_if<Test>(&facts.node(node).instruction);
  if (!test || !test->condition || isWhile(facts, node) || oppositeAbove(facts, context, node))
    return false;
  const auto decided = decidedAbove(facts, context, node, *test->condition);
  if (!decided)
    return false;
  const Span span = context.tree.expressions[*test->condition].span;
  reporter.report(
      {.message = fmt::format("{} is {} true here", context.quoted(span), decided->isTrue ? "always" : "never"),
       .span = span,
       .labels = {{context.tree.expressions[decided->by].span, "decides it"}},
       .notes = {"nothing between the two changes a variable of the condition",
                 "test it where the variable has its new value, or correct the condition"}},
      Severity::Warning);
  return true;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    if (facts.isReached(node) && std::holds_alternative<Test>(facts.node(node).instruction) &&
        facts.truthOf(node) == Truth::Maybe)
      checkOpposites(facts, context, node, reporter);
  std::vector<NodeId> told;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    if (facts.isReached(node) && checkDecided(facts, context, node, reporter))
      told.push_back(node);
  if (isMainProgram(facts))
    return; // settings at its head are asked on purpose
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    if (std::ranges::binary_search(told, node))
      continue;
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    const auto truth = test && test->condition ? facts.truthOf(node) : std::nullopt;
    if (!truth || *truth == Truth::Maybe || isConstant(context.tree, *test->condition))
      continue;
    const BlockId block = facts.node(node).block;
    const bool isLoop = isWhile(facts, node);
    auto reason = isLoop ? std::nullopt : voidReason(facts, context, node, *test->condition, *truth);
    const bool toBeSure =
        isAskedToBeSure(facts, *test->condition, block) && !(reason && asksVacancy(context, *test->condition));
    if (isLoop || toBeSure)
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
