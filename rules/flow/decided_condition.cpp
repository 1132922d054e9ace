// decided-condition: an IF that can have one outcome only, given what was decided or computed before it.
#include "rules/flow/loop_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::decided_condition {
namespace {

/// `#101EQ#0`: whether a variable is vacant is asked.
bool asksVacancy(const FileContext &context, ExpressionId condition) {
  const auto *relation = asInside<BinaryOperation>(context.tree, condition);
  return relation && (isVacant(context, relation->left) || isVacant(context, relation->right));
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
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
    const bool vacancy = asksVacancy(context, *test->condition);
    if (isWhile || isAskedToBeSure(facts, *test->condition, block))
      continue;
    const Span span = context.tree.expressions[*test->condition].span;
    reporter.report(
        {.message = fmt::format("{} {} here", context.quoted(span),
                                *truth == Truth::True ? "is always true" : "is never true"),
         .span = span,
         .flow = pathFromEntry(facts, node),
         .notes = {vacancy && *truth == Truth::False ? "it has been set before, so it holds a number and is not vacant"
                                                     : "the blocks before it leave no other outcome"}});
  }
}

} // namespace

extern const Rule decidedCondition;
const Rule decidedCondition{.info = {"decided-condition", Category::Flow, Severity::Info,
                                     "Reports a condition that always has the same outcome."},
                            .hooks = {.flow = check, .flowRuns = FlowRuns::All}};

} // namespace feedhold::rules::decided_condition
