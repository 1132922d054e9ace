// first-check-too-narrow: `IF[[#1-#2]EQ#3]GOTO50`, a cut by #3, and `IF[[#1-#2]LT#3]GOTO50`.
#include "rules/flow/flow_view.h"
#include "rules/motion/motion_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::first_check_too_narrow {
namespace {

/// `IF[a EQ b]GOTO n`
struct Check {
  BlockId block;
  ExpressionId condition;
  const BinaryOperation *relation;
  BlockId target;
};

std::vector<Check> checksOf(const FlowFacts &facts, const FileContext &context) {
  std::vector<Check> checks;
  for (const Jump &jump : context.model.jumpsOf(facts.program)) {
    if (jump.kind != JumpKind::Goto || !jump.conditional || !jump.target)
      continue;
    for (const Statement &statement : context.tree.statementsOf(jump.block)) {
      const auto condition = conditionOf(statement);
      const auto *relation = condition ? asInside<BinaryOperation>(context.tree, *condition) : nullptr;
      if (relation && !std::holds_alternative<While>(statement.node))
        checks.push_back({jump.block, *condition, relation, *jump.target});
    }
  }
  return checks;
}

bool comparesTheSame(const Check &first, const Check &second, const FileContext &context) {
  const auto isSame = [&](ExpressionId a, ExpressionId b) {
    return sameText(context, context.tree.expressions[a].span, context.tree.expressions[b].span);
  };
  return first.target == second.target && isSame(first.relation->left, second.relation->left) &&
         isSame(first.relation->right, second.relation->right);
}

bool reads(const std::vector<Read> &all, std::uint32_t variable) {
  return std::ranges::any_of(all, [&](const Read &read) { return read.number == variable; });
}

/// Between the two checks the tool moves by a step that they compare, and what they compare is assigned anew: one pass.
bool isPassBetween(const Check &first, const Check &second, const FlowFacts &facts, const FileContext &context) {
  const std::vector<Read> step = readsIn(facts.file, first.relation->right, first.block);
  const std::vector<Read> rest = readsIn(facts.file, first.relation->left, first.block);
  bool moves = false;
  bool advances = false;
  for (BlockId block = first.block.next(); block < second.block; block = block.next()) {
    for (const Word &word : context.tree.wordsOf(block))
      if (axisOf(word.address()) && word.form() == WordForm::Expression)
        for (const Read &read : readsIn(facts.file, word.expression(), block))
          moves = moves || (read.number && reads(step, *read.number));
    for (const VariableUse &use : context.model.variablesIn(block, block.next()))
      advances = advances || (use.write && use.number && reads(rest, *use.number));
  }
  return moves && advances;
}

/// Behind the second check the program goes back to the first one.
bool leadsBack(const Check &first, const Check &second, const FileContext &context, ProgramId program) {
  return std::ranges::any_of(context.model.jumpsOf(program), [&](const Jump &jump) {
    return jump.kind == JumpKind::Goto && jump.target && jump.block > second.block && *jump.target <= first.block;
  });
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  const std::vector<Check> checks = checksOf(facts, context);
  for (const Check &first : checks) {
    if (first.relation->op != OperatorKind::Equal)
      continue;
    const auto second = std::ranges::find_if(checks, [&](const Check &other) {
      return other.block > first.block && other.relation->op == OperatorKind::LessThan &&
             comparesTheSame(first, other, context);
    });
    if (second == checks.end() || !isPassBetween(first, *second, facts, context) ||
        !leadsBack(first, *second, context, facts.program))
      continue;
    reporter.report(
        {.message = fmt::format("{} lets less than a step through",
                                context.quoted(context.tree.expressions[first.condition].span)),
         .span = context.tree.expressions[first.condition].span,
         .labels = {{context.tree.expressions[second->condition].span, "behind the step, less leads there too"}},
         .notes = {"if less is left at the first pass already, the step goes beyond the end",
                   "compare with `LE` before the step"}});
  }
}

} // namespace

extern const Rule firstCheckTooNarrow;
const Rule firstCheckTooNarrow{.info = {"first-check-too-narrow", Category::Flow, Severity::Warning,
                                        "Reports a check for equality before a step, where the same check behind the "
                                        "step asks for less."},
                               .hooks = {.flow = check}};

} // namespace feedhold::rules::first_check_too_narrow
