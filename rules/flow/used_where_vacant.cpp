// used-where-vacant: `IF[#7NE#0]GOTO90`, then `#1=#7*2`.
#include "rules/flow/definitions.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace feedhold::rules::used_where_vacant {
namespace {

/// `#7NE#0` or `#7EQ#0`: the variable that is asked, and the outcome with which it is vacant.
struct Question {
  std::uint32_t variable;
  bool vacantWhenTrue;
};

std::optional<Question> questionIn(const FlowFacts &facts, const FileContext &context, ExpressionId condition) {
  const auto *relation = asInside<BinaryOperation>(context.tree, condition);
  if (!relation || (relation->op != OperatorKind::Equal && relation->op != OperatorKind::NotEqual) ||
      !isVacant(context, relation->right))
    return std::nullopt;
  const auto variable = variableOf(facts, relation->left);
  return variable ? std::optional(Question{*variable, relation->op == OperatorKind::Equal}) : std::nullopt;
}

/// An alarm comes soon: `N800`, `M05`, `G65 P910002(SENSOR OFF)`, `#3000=1`.
bool comesToAlarm(const FlowFacts &facts, const FileContext &context, BlockId block) {
  constexpr int kFarthest = 10;
  const BlockId last = context.model.programs[facts.program].last;
  for (int i = 0; i < kFarthest && block < last; ++i, block = block.next()) {
    const auto uses = context.model.variablesIn(block, block.next());
    if (std::ranges::any_of(uses, [&](const VariableUse &use) {
          return use.write && use.number && raisesAlarm(context.dialect, *use.number);
        }))
      return true;
    if (flowAfter(context.tree, block, context.dialect) != FlowAfter::Next)
      return false;
  }
  return false;
}

/// With the other outcome of the test.
bool turnsOthersAway(const FlowFacts &facts, const FileContext &context, const PassedTest &passed) {
  const BlockId block = facts.node(passed.node).block;
  if (passed.isTrue)
    return comesToAlarm(facts, context, block.next());
  const auto jumps = context.model.jumpsIn(block, block.next());
  return jumps.size() == 1 && jumps.front().target && comesToAlarm(facts, context, *jumps.front().target);
}

/// `IF[#7NE#0]THEN#3000=1`: to the text, the program goes on behind it.
std::optional<NodeId> alarmBefore(const FlowFacts &facts, const FileContext &context, std::uint32_t variable,
                                  NodeId at) {
  for (NodeId node = facts.entry(); node < at; node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    const auto question = test && test->condition ? questionIn(facts, context, *test->condition) : std::nullopt;
    if (question && question->variable == variable && !question->vacantWhenTrue &&
        raisesAlarmAt(facts.file, facts.node(node).block) && isPassedAlways(facts, node, at))
      return node;
  }
  return std::nullopt;
}

/// The test behind which the variable is vacant at the place.
std::optional<NodeId> decidingTest(const FlowFacts &facts, const FileContext &context, std::uint32_t variable,
                                   NodeId at) {
  for (const PassedTest &passed : testsBefore(facts, at)) {
    const auto *test = std::get_if<Test>(&facts.node(passed.node).instruction);
    const auto question = test && test->condition ? questionIn(facts, context, *test->condition) : std::nullopt;
    // Without an alarm for the other calls, two kinds of calls are told apart, and this is the one without the
    // argument.
    if (question && question->variable == variable && question->vacantWhenTrue == passed.isTrue &&
        turnsOthersAway(facts, context, passed))
      return passed.node;
  }
  return alarmBefore(facts, context, variable, at);
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts) || isMainProgram(facts))
    return;
  std::set<std::uint32_t> told;
  for (const Read &read : readsOf(facts)) {
    const AbstractValue *value = facts.valueOf(read.expression);
    const bool countsAsZero = read.use == ReadUse::Computed || read.use == ReadUse::Ordering;
    if (!countsAsZero || !read.number || told.contains(*read.number) || !value || !value->isVacant())
      continue;
    const auto node = nodeOf(facts, read.block, read.expression);
    const auto test = node ? decidingTest(facts, context, *read.number, *node) : std::nullopt;
    if (!test || facts.node(*test).block == read.block)
      continue;
    told.insert(*read.number);
    const ExpressionId condition = *std::get<Test>(facts.node(*test).instruction).condition;
    reporter.report({.message = fmt::format("{} is vacant here: the check before it lets nothing else pass",
                                            describeVariable(context.dialect, *read.number)),
                     .span = context.tree.expressions[read.expression].span,
                     .labels = {{context.tree.expressions[condition].span, "the check"}},
                     .notes = {isLocal(facts.file, *read.number)
                                   ? "it counts as 0, and every call that passes a value is turned away"
                                   : "it counts as 0, and the program stops with an alarm wherever it holds a value",
                               "the check asks for the opposite: exchange EQ and NE"}});
  }
}

} // namespace

extern const Rule usedWhereVacant;
const Rule usedWhereVacant{
    .info = {"used-where-vacant", Category::Flow, Severity::Warning,
             "Reports a variable that is computed with, or compared as a number, where a check has left it vacant."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::used_where_vacant
