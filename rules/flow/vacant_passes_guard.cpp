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

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.behaviour.variablesMayBeVacant || isMainProgram(facts) || isCalledAsSubprogram(facts))
    return;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    const BlockId block = facts.node(node).block;
    if (!test || !test->condition || !facts.isReached(node) || !guardsAlarm(facts, block))
      continue;
    for (const ExpressionId part : subexpressions(context.tree, *test->condition)) {
      const auto *relation = as<BinaryOperation>(context.tree, part);
      const auto variable = relation ? comparedWithZero(context.tree, *relation) : std::nullopt;
      const AbstractValue *value = variable ? facts.valueOf(*variable) : nullptr;
      const auto number = variable ? variableNumber(context.tree, *variable) : std::nullopt;
      if (!value || !value->mayBeVacant() || !value->mayBeNumber() || !isLocal(facts.file, *number) ||
          !argumentBehind(facts, *number) || isRefusedElsewhere(facts, *number))
        continue;
      const Span span = context.tree.expressions[part].span;
      reporter.report(
          {.message = fmt::format("{} does not catch a missing {}", context.quoted(span),
                                  describeVariable(context.dialect, *number)),
           .span = span,
           .notes = {
               "an argument that is not passed is vacant, and `EQ` does not treat vacant as 0: no alarm is raised",
               fmt::format("check `[#{} EQ #0]` as well", *number)}});
    }
  }
}

} // namespace

extern const Rule vacantPassesGuard;
const Rule vacantPassesGuard{
    .info = {"vacant-passes-guard", Category::Flow, Severity::Warning,
             "Reports a check of an argument by `EQ 0` that does not catch a missing argument."},
    .hooks = {.flow = check, .flowRuns = FlowRuns::All}};

} // namespace feedhold::rules::vacant_passes_guard
