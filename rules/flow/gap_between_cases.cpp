// gap-between-cases: `IF[#1LT5]THEN#2=10` and `IF[#1GT5]THEN#2=20`: at 5 neither sets `#2`.  The limit may be a
// variable.
#include "rules/flow/flow_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace feedhold::rules::gap_between_cases {
namespace {

/// `IF[#1LT5]THEN#2=10`, as it stands in one block.
struct Case {
  BlockId block;
  std::uint32_t asked;
  std::uint32_t set;
  OperatorKind op;
  std::string limit; // `5`, `#4`
  Span span;
};

/// A number, or a variable.
std::optional<std::string> limitOf(const FileContext &context, ExpressionId id) {
  if (const auto number = literalValue(context.tree, id))
    return number->toString();
  const auto variable = variableNumber(context.tree, unwrapped(context.tree, id));
  return variable ? std::optional(fmt::format("#{}", *variable)) : std::nullopt;
}

/// Absent for another statement, and for a condition with more than one comparison.
std::optional<Case> caseIn(const FlowFacts &facts, const FileContext &context, NodeId node) {
  const auto *test = std::get_if<Test>(&facts.node(node).instruction);
  const auto *relation = test && test->condition ? asInside<BinaryOperation>(context.tree, *test->condition) : nullptr;
  if (!relation || !isRelation(relation->op))
    return std::nullopt;
  const auto asked = variableNumber(context.tree, unwrapped(context.tree, relation->left));
  const auto limit = limitOf(context, relation->right);
  const BlockId block = facts.node(node).block;
  if (!asked || !limit)
    return std::nullopt;
  for (const Statement &statement : context.tree.statementsOf(block))
    if (const auto *assignment = std::get_if<Assignment>(&statement.node); assignment && statement.nested)
      // An alarm keeps no value: between two of them all is well.
      if (const auto set = variableNumber(context.tree, unwrapped(context.tree, assignment->target));
          set && !raisesAlarm(context.dialect, *set))
        return Case{block, *asked, *set, relation->op, *limit, context.tree.expressions[*test->condition].span};
  return std::nullopt;
}

std::vector<Case> casesOf(const FlowFacts &facts, const FileContext &context) {
  std::vector<Case> cases;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    if (facts.isReached(node))
      if (const auto found = caseIn(facts, context, node))
        cases.push_back(*found);
  return cases;
}

/// Only these cases set the variable: it has no value before them.
bool hasNoDefault(const FileContext &context, ProgramId program, const std::vector<Case> &cases,
                  std::uint32_t variable) {
  return std::ranges::all_of(context.model.variablesOf(program), [&](const VariableUse &use) {
    return !use.write || (use.number && use.number != variable) ||
           std::ranges::find(cases, use.block, &Case::block) != cases.end();
  });
}

/// A condition of the program asks for the limit itself, in a case or before them: `IF[#1EQ5.]GOTO90`.
bool asksForLimit(const FlowFacts &facts, const FileContext &context, const Case &one) {
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    if (!test || !test->condition)
      continue;
    for (const ExpressionId part : subexpressions(context.tree, *test->condition)) {
      const auto *relation = as<BinaryOperation>(context.tree, part);
      if (relation && isRelation(relation->op) && relation->op != OperatorKind::LessThan &&
          relation->op != OperatorKind::GreaterThan &&
          variableNumber(context.tree, unwrapped(context.tree, relation->left)) == one.asked &&
          limitOf(context, relation->right) == one.limit)
        return true;
    }
  }
  return false;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts))
    return;
  const std::vector<Case> cases = casesOf(facts, context);
  for (const Case &below : cases) {
    if (below.op != OperatorKind::LessThan || asksForLimit(facts, context, below))
      continue;
    const auto above = std::ranges::find_if(cases, [&](const Case &other) {
      return other.op == OperatorKind::GreaterThan && other.asked == below.asked && other.set == below.set &&
             other.limit == below.limit;
    });
    if (above == cases.end() || !hasNoDefault(context, facts.program, cases, below.set))
      continue;
    reporter.report(
        {.message = fmt::format("where `#{}` is exactly {}, nothing sets `#{}`", below.asked, below.limit, below.set),
         .span = above->span,
         .labels = {{below.span, "nor does this"}},
         .notes = {fmt::format("`#{}` is vacant then, or has the value of an earlier run", below.set),
                   "write GE or LE in one of the conditions"}});
    return;
  }
}

} // namespace

extern const Rule gapBetweenCases;
const Rule gapBetweenCases{.info = {"gap-between-cases", Category::Flow, Severity::Warning,
                                    "Reports two conditions that set a variable below and above a number, and none at "
                                    "the number itself."},
                           .hooks = {.flow = check}};

} // namespace feedhold::rules::gap_between_cases
