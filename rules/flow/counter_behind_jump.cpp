// counter-behind-jump: `IF[#26LT10]GOTO74`, then `#26=#26+1`.
#include "rules/expressions/expression_view.h"
#include "rules/structure/structure_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::counter_behind_jump {
namespace {

constexpr std::size_t kFarthest = 3; // blocks with content between the jump and the counter

/// `#26LT10`: a variable against a limit.
std::optional<std::uint32_t> counterOf(const FileContext &context, ExpressionId condition) {
  const auto *relation = asInside<BinaryOperation>(context.tree, condition);
  return relation && isRelation(relation->op) ? variableNumber(context.tree, unwrapped(context.tree, relation->left))
                                              : std::nullopt;
}

/// Some block from `first` to, not including, `last` may give one of the variables of the condition another value.
bool mayChange(const FileContext &context, BlockId first, BlockId last, std::uint32_t counter, ExpressionId condition) {
  std::vector<std::uint32_t> asked{counter};
  for (const ExpressionId part : subexpressions(context.tree, condition)) {
    if (as<IndirectVariable>(context.tree, part))
      return true;
    if (const auto number = variableNumber(context.tree, part))
      asked.push_back(*number);
  }
  const auto isOwn = [&](std::uint32_t number) {
    const VariableRange *range = findVariable(context.dialect, number);
    return range && (range->kind == VariableKind::Local || range->kind == VariableKind::Vacant);
  };
  const bool areOwn = std::ranges::all_of(asked, isOwn);
  for (const Call &call : context.model.callsIn(first, last))
    if (!areOwn || (call.kind != CallKind::Macro && call.kind != CallKind::Modal))
      return true;
  return std::ranges::any_of(context.model.variables, [&](const VariableUse &use) {
    return use.write && use.block >= first && use.block < last && use.number &&
           std::ranges::find(asked, *use.number) != asked.end();
  });
}

/// `#26=#26+1`
const Assignment *stepIn(const FileContext &context, BlockId block, std::uint32_t counter) {
  const Statement *statement = firstStatement(context.tree, block);
  const auto *assignment = statement ? std::get_if<Assignment>(&statement->node) : nullptr;
  if (!assignment || variableNumber(context.tree, assignment->target) != counter)
    return nullptr;
  const auto *sum = asInside<BinaryOperation>(context.tree, assignment->value);
  const bool isStep = sum && (sum->op == OperatorKind::Add || sum->op == OperatorKind::Subtract) &&
                      variableNumber(context.tree, unwrapped(context.tree, sum->left)) == counter;
  return isStep ? assignment : nullptr;
}

/// The counter behind the jump, unless another way leads there or back.
const Assignment *stepBehind(const FileContext &context, const Jump &jump, std::uint32_t counter) {
  const Program &program = context.model.programs[jump.program];
  std::size_t seen = 0;
  for (BlockId block = jump.block.next(); block < program.last && seen < kFarthest; block = block.next()) {
    if (isEmpty(context.tree, block))
      continue;
    ++seen;
    const bool isTarget = std::ranges::any_of(context.model.jumpsOf(jump.program),
                                              [&](const Jump &other) { return other.target == block; });
    if (isTarget || !context.model.jumpsIn(block, block.next()).empty())
      return nullptr;
    if (const Assignment *step = stepIn(context, block, counter))
      return step;
  }
  return nullptr;
}

/// The condition of the IF whose action the jump is.
std::optional<ExpressionId> conditionOfJump(const FileContext &context, const Jump &jump) {
  const Statement *statement = firstStatement(context.tree, jump.block);
  const auto *branch = statement ? std::get_if<If>(&statement->node) : nullptr;
  return branch && branch->action == IfAction::Jump ? branch->condition : std::nullopt;
}

void check(const Jump &jump, const FileContext &context, const Reporter &reporter) {
  if (jump.kind != JumpKind::Goto || !jump.target || *jump.target > jump.block)
    return;
  const auto condition = conditionOfJump(context, jump);
  const auto counter = condition ? counterOf(context, *condition) : std::nullopt;
  if (!counter || mayChange(context, *jump.target, jump.block, *counter, *condition))
    return;
  const Assignment *step = stepBehind(context, jump, *counter);
  if (!step)
    return;
  const Span span = cover(context.tree.expressions[step->target].span, context.tree.expressions[step->value].span);
  const Span asked = context.tree.expressions[*condition].span;
  reporter.report(
      {.message = fmt::format("{} stands behind the jump that repeats the loop, and nothing else changes {}",
                              context.quoted(span), context.quoted(asked)),
       .span = span,
       .labels = {{jump.span, "this jump goes back without it"}},
       .notes = {"once the control jumps back, the condition stays true: the loop never ends",
                 "move the counter before the IF"}});
}

} // namespace

extern const Rule counterBehindJump;
const Rule counterBehindJump{.info = {"counter-behind-jump", Category::Flow, Severity::Warning,
                                      "Reports a loop by `GOTO` whose counter is changed only behind the jump."},
                             .hooks = {.jump = check}};

} // namespace feedhold::rules::counter_behind_jump
