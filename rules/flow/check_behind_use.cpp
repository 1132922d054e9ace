// check-behind-use: `#5=10/#4`, then `IF[#4EQ#0]GOTO90`.
#include "rules/flow/definitions.h"
#include "rules/motion/motion_view.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace feedhold::rules::check_behind_use {
namespace {

enum class UseKind : std::uint8_t { Divisor, Word };

struct Use {
  UseKind kind;
  NodeId node;
  Span span;
};

struct Check {
  NodeId test;
  ExpressionId relation;
  std::uint32_t argument;
  bool asksVacancy; // `EQ #0`; else for 0
};

/// `#4EQ#0`, `#4EQ0`, `#4LE0`, of an argument that is as it was passed.
std::optional<Check> checkIn(const FlowFacts &facts, const FileContext &context, NodeId test, ExpressionId part) {
  const auto *relation = as<BinaryOperation>(context.tree, part);
  if (!relation || (relation->op != OperatorKind::Equal && relation->op != OperatorKind::LessOrEqual))
    return std::nullopt;
  const auto argument = variableOf(facts, relation->left);
  const auto limit = literalValue(context.tree, relation->right);
  const bool asksVacancy = relation->op == OperatorKind::Equal && isVacant(context, relation->right);
  if (!argument || !letterOfArgument(context.dialect, *argument) || (!asksVacancy && !(limit && limit->isZero())))
    return std::nullopt;
  const auto known = definitionsOf(facts, *argument, test);
  return known && known->fromEntry && known->nodes.empty() ? std::optional(Check{test, part, *argument, asksVacancy})
                                                           : std::nullopt;
}

std::vector<Check> checksOf(const FlowFacts &facts, const FileContext &context) {
  std::vector<Check> found;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    if (!test || !test->condition || !facts.isReached(node) || !leadsToAlarm(facts, facts.node(node).block))
      continue;
    for (const ExpressionId part : subexpressions(context.tree, *test->condition))
      if (const auto each = checkIn(facts, context, node, part))
        found.push_back(*each);
  }
  return found;
}

/// The control may stop at a division by the argument.
std::optional<Use> divisionAt(const FlowFacts &facts, NodeId node, std::uint32_t argument) {
  for (const AlarmFact &alarm : facts.alarms()) {
    if (alarm.node != node || alarm.kind != AlarmKind::DivideByZero)
      continue;
    const auto divisor = expressionAt(facts, facts.node(node).block, alarm.place);
    if (divisor && variableOf(facts, *divisor) == argument)
      return Use{UseKind::Divisor, node, alarm.place};
  }
  return std::nullopt;
}

/// A move with a coordinate that is left out when the argument is vacant.
std::optional<Use> wordAt(const FlowFacts &facts, const MotionView &view, NodeId node, std::uint32_t argument) {
  for (const Word *word : view.modalMotionWords(node))
    if (word->form() == WordForm::Expression && variableOf(facts, word->expression()) == argument)
      return Use{UseKind::Word, node, word->span()};
  return std::nullopt;
}

/// Some condition up to the node asks for the argument: the use may be its branch.
bool isAskedUpTo(const FlowFacts &facts, NodeId last, std::uint32_t argument) {
  for (NodeId node = facts.entry(); node <= last; node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    if (!test || !test->condition)
      continue;
    const auto reads = readsIn(facts.file, *test->condition, facts.node(node).block);
    if (std::ranges::any_of(reads, [&](const Read &read) { return read.number == argument; }))
      return true;
  }
  return false;
}

std::optional<Use> useBefore(const FlowFacts &facts, const MotionView &view, const Check &check) {
  for (NodeId node = facts.entry(); node < check.test; node = node.next()) {
    if (!facts.isReached(node))
      continue;
    auto use = divisionAt(facts, node, check.argument);
    if (!use && check.asksVacancy)
      use = wordAt(facts, view, node, check.argument);
    if (use)
      return !isAskedUpTo(facts, node, check.argument) && isPassedAlways(facts, node, check.test) ? use : std::nullopt;
  }
  return std::nullopt;
}

std::string consequence(const Use &use, const FileContext &context) {
  if (use.kind == UseKind::Divisor)
    return fmt::format("without it, the control {} at the division, not with the alarm of the check",
                       stopsWith(context.dialect, AlarmKind::DivideByZero));
  return "without it, the control ignores the word, and has moved the other axes before the check";
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts) || isMainProgram(facts))
    return;
  const auto checks = checksOf(facts, context);
  if (checks.empty())
    return;
  const MotionView view(facts.program, context);
  std::set<std::uint32_t> done;
  for (const Check &each : checks) {
    const auto use = done.contains(each.argument) ? std::nullopt : useBefore(facts, view, each);
    if (!use)
      continue;
    done.insert(each.argument);
    const Span span = context.tree.expressions[each.relation].span;
    reporter.report({.message = fmt::format("{} is checked after its use: {} comes too late",
                                            describeVariable(context.dialect, each.argument), context.quoted(span)),
                     .span = span,
                     .labels = {{use->span, "used here"}},
                     .notes = {consequence(*use, context), "move the check before this use"}});
  }
}

} // namespace

extern const Rule checkBehindUse;
const Rule checkBehindUse{.info = {"check-behind-use", Category::Flow, Severity::Warning,
                                   "Reports a check of an argument behind the block that needs the checked value."},
                          .hooks = {.flow = check}};

} // namespace feedhold::rules::check_behind_use
