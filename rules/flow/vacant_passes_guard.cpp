// vacant-passes-guard: `IF[#1EQ0]` lets an argument through that was not passed.
#include "rules/flow/flow_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::vacant_passes_guard {
namespace {

/// `#18EQ0` or `0EQ#18`: the variable.
std::optional<ExpressionId> comparedWithZero(const SyntaxTree &tree, const BinaryOperation &relation) {
  if (relation.op != OperatorKind::Equal)
    return std::nullopt;
  for (const auto &[variable, zero] :
       {std::pair{relation.left, relation.right}, std::pair{relation.right, relation.left}})
    if (const auto value = literalValue(tree, zero);
        value && value->isZero() && variableNumber(tree, unwrapped(tree, variable)))
      return unwrapped(tree, variable);
  return std::nullopt;
}

/// The block raises an alarm, or the one behind it where the block is a lone label.
bool raisesAlarm(const ProgramFile &file, BlockId block) {
  const auto raises = [&](BlockId each) {
    const auto uses = file.model->variablesIn(each, each.next());
    return std::ranges::any_of(uses, [&](const VariableUse &use) {
      return use.write && use.number && raisesAlarm(*file.dialect, *use.number);
    });
  };
  return raises(block) || raises(block.next());
}

/// The condition leads to an alarm.
bool guardsAlarm(const FlowFacts &facts, BlockId block) {
  const auto jumps = facts.file.model->jumpsIn(block, block.next());
  return std::ranges::any_of(jumps,
                             [&](const Jump &jump) { return jump.target && raisesAlarm(facts.file, *jump.target); }) ||
         (jumps.empty() && raisesAlarm(facts.file, block));
}

/// Some comparison in the program refuses the vacant variable as well: with `#0`, or `LE 0`, `LT 1`.
bool isRefusedElsewhere(const FlowFacts &facts, std::uint32_t variable) {
  const SyntaxTree &tree = *facts.file.tree;
  const auto isOther = [&](ExpressionId id) {
    const auto *relation = as<BinaryOperation>(tree, id);
    if (!relation || !isRelation(relation->op) || comparedWithZero(tree, *relation))
      return false;
    return variableNumber(tree, unwrapped(tree, relation->left)) == variable ||
           variableNumber(tree, unwrapped(tree, relation->right)) == variable;
  };
  for (const VariableUse &use : facts.file.model->variablesOf(facts.program))
    if (use.number == variable && !use.write) {
      const auto all = expressionsOf(facts.file, use.block);
      if (std::ranges::any_of(all, isOther))
        return true;
    }
  return false;
}

/// `IF[#13EQ0]THEN#13=5.`, and nothing else sets the variable: a default that a missing argument does not get.
bool givesDefault(const FlowFacts &facts, BlockId block, std::uint32_t variable) {
  const auto uses = facts.file.model->variablesOf(facts.program);
  const auto sets = [&](const VariableUse &use) { return use.write && use.number == variable; };
  return letterOfArgument(*facts.file.dialect, variable) && std::ranges::count_if(uses, sets) == 1 &&
         std::ranges::any_of(facts.file.model->variablesIn(block, block.next()), sets);
}

struct Guard {
  Span span;
  std::uint32_t variable;
  bool isDefault;
};

/// The comparison lets the argument pass that it is to stop.
std::optional<Guard> passingGuard(const FlowFacts &facts, const FileContext &context, BlockId block,
                                  ExpressionId part) {
  const auto *relation = as<BinaryOperation>(context.tree, part);
  const auto variable = relation ? comparedWithZero(context.tree, *relation) : std::nullopt;
  const AbstractValue *value = variable ? facts.valueOf(*variable) : nullptr;
  const auto number = variable ? variableNumber(context.tree, *variable) : std::nullopt;
  if (!value || !value->mayBeVacant() || !value->mayBeNumber() || !isLocal(facts.file, *number) ||
      mayHoldCallersValue(facts, *number) || isRefusedElsewhere(facts, *number))
    return std::nullopt;
  const Guard guard{context.tree.expressions[part].span, *number, givesDefault(facts, block, *number)};
  const bool stops = guardsAlarm(facts, block) && argumentBehind(facts, *number);
  return stops || guard.isDefault ? std::optional(guard) : std::nullopt;
}

/// One finding for all guards of a program that are written alike.
void tell(const std::vector<Guard> &guards, const FileContext &context, const Reporter &reporter) {
  const Guard &first = guards.front();
  Diagnostic diagnostic{
      .message = fmt::format("{} does not catch a missing {}", context.quoted(first.span),
                             describeVariable(context.dialect, first.variable)),
      .span = first.span,
      .notes = {fmt::format("an argument that is not passed is vacant, and `EQ` does not treat vacant as 0: {}",
                            first.isDefault ? "it does not get this value" : "no alarm is raised"),
                fmt::format("check `[#{} EQ #0]` {}", first.variable, first.isDefault ? "instead" : "as well")}};
  for (std::size_t i = 1; i < guards.size(); ++i)
    diagnostic.labels.push_back(
        {guards[i].span, fmt::format("nor this a missing {}", describeVariable(context.dialect, guards[i].variable))});
  reporter.report(std::move(diagnostic));
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.behaviour.variablesMayBeVacant || isMainProgram(facts))
    return;
  std::vector<Guard> guards;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    if (!test || !test->condition || !facts.isReached(node))
      continue;
    for (const ExpressionId part : subexpressions(context.tree, *test->condition))
      if (const auto guard = passingGuard(facts, context, facts.node(node).block, part))
        guards.push_back(*guard);
  }
  if (!guards.empty())
    tell(guards, context, reporter);
}

} // namespace

extern const Rule vacantPassesGuard;
const Rule vacantPassesGuard{
    .info = {"vacant-passes-guard", Category::Flow, Severity::Warning,
             "Reports a check or a default of an argument by `EQ 0` that does not catch a missing argument."},
    .hooks = {.flow = check, .flowRuns = FlowRuns::All}};

} // namespace feedhold::rules::vacant_passes_guard
