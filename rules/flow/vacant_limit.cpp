// vacant-limit: `IF[ABS[#5041-#24]GT#8]GOTO90`, and nothing asks whether the tolerance E was passed.
#include "rules/flow/definitions.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::vacant_limit {
namespace {

struct Limit {
  ExpressionId place;
  std::uint32_t variable;
  std::uint32_t argument;
  bool isUpper; // the alarm is raised above it
};

/// Some comparison asks for the variable itself: for vacant, or against a constant.
bool isCheckedAlone(const FlowFacts &facts, std::uint32_t variable) {
  const SyntaxTree &tree = *facts.file.tree;
  const auto asks = [&](ExpressionId id) {
    const auto *relation = as<BinaryOperation>(tree, id);
    if (!relation || !isRelation(relation->op))
      return false;
    const auto isIt = [&](ExpressionId side) { return variableNumber(tree, unwrapped(tree, side)) == variable; };
    const auto isOrder = relation->op != OperatorKind::Equal && relation->op != OperatorKind::NotEqual;
    return (isIt(relation->left) && (!isOrder || isConstant(tree, relation->right))) ||
           (isIt(relation->right) && (!isOrder || isConstant(tree, relation->left)));
  };
  for (const VariableUse &use : facts.file.model->variablesOf(facts.program))
    if (use.number == variable && !use.write && std::ranges::any_of(expressionsOf(facts.file, use.block), asks))
      return true;
  return false;
}

/// `ABS[..]`, or a variable that holds nothing else.
bool isDeviation(const FlowFacts &facts, ExpressionId id, NodeId at) {
  const auto isAbs = [&](ExpressionId each) {
    const auto *call = asInside<FunctionCall>(*facts.file.tree, each);
    return call && call->function == FunctionKind::Abs;
  };
  const auto variable = variableOf(facts, id);
  const auto known = variable ? definitionsOf(facts, *variable, at) : std::nullopt;
  return isAbs(id) || (known && !known->fromEntry && std::ranges::all_of(known->nodes, [&](NodeId node) {
                         const auto assignment = assignmentTo(facts, node, *variable);
                         return assignment && isAbs(assignment->value);
                       }));
}

/// `ABS[..]GT#8`, `#8LT#104`: the argument is the limit of a deviation.
std::optional<Limit> limitIn(const FlowFacts &facts, const BinaryOperation &relation, NodeId node) {
  if (!isRelation(relation.op) || relation.op == OperatorKind::Equal || relation.op == OperatorKind::NotEqual)
    return std::nullopt;
  const SyntaxTree &tree = *facts.file.tree;
  const bool wantsGreater = relation.op == OperatorKind::GreaterThan || relation.op == OperatorKind::GreaterOrEqual;
  for (const auto &[quantity, limit, isUpper] : {std::tuple{relation.left, relation.right, wantsGreater},
                                                 std::tuple{relation.right, relation.left, !wantsGreater}}) {
    const auto variable = variableNumber(tree, unwrapped(tree, limit));
    const AbstractValue *bound = variable ? facts.valueOf(unwrapped(tree, limit)) : nullptr;
    if (!bound || !bound->mayBeVacant() || !isLocal(facts.file, *variable) || !isDeviation(facts, quantity, node))
      continue;
    if (const auto argument = argumentBehind(facts, *variable))
      return Limit{unwrapped(tree, limit), *variable, *argument, isUpper};
  }
  return std::nullopt;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.behaviour.variablesMayBeVacant || isMainProgram(facts))
    return;
  std::vector<std::uint32_t> done;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    const auto *relation = test && test->condition && facts.isReached(node)
                               ? asInside<BinaryOperation>(context.tree, *test->condition)
                               : nullptr;
    const auto limit = relation ? limitIn(facts, *relation, node) : std::nullopt;
    const auto whenTrue = limit ? alarmWhenTrue(facts, node) : std::nullopt;
    if (!whenTrue || std::ranges::find(done, limit->argument) != done.end() || isCheckedAlone(facts, limit->variable) ||
        isCheckedAlone(facts, limit->argument) || mayHoldCallersValue(facts, limit->argument) ||
        isAlwaysPassed(facts, limit->argument))
      continue;
    done.push_back(limit->argument);
    const bool firesAlways = limit->isUpper == *whenTrue;
    reporter.report(
        {.message = fmt::format("{} decides whether the alarm is raised, and may be vacant: nothing checks it",
                                describeVariable(context.dialect, limit->argument)),
         .span = context.tree.expressions[limit->place].span,
         .labels = {{context.tree.expressions[*test->condition].span, "decides about the alarm"}},
         .notes = {fmt::format("if it is not passed, it counts as 0: {} raises the alarm",
                               firesAlways ? "every difference" : "no difference"),
                   fmt::format("check `IF[#{} EQ #0]` at the head of the program", limit->argument)}});
  }
}

} // namespace

extern const Rule vacantLimit;
const Rule vacantLimit{.info = {"vacant-limit", Category::Flow, Severity::Warning,
                                "Reports an alarm whose limit is an argument that is never checked for vacant."},
                       .hooks = {.flow = check}};

} // namespace feedhold::rules::vacant_limit
