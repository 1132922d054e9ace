// inexact-equality: `IF[#4EQ#1]`, where #4 is computed and differs from #1 in the last digit.
#include "rules/flow/formula.h"
#include "rules/flow/loop_view.h"
#include "rules/flow/margin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace feedhold::rules::inexact_equality {
namespace {

struct Comparison {
  NodeId test;
  const BinaryOperation *relation;
  Span span;
};

/// EQ and NE of conditions, those joined by AND and OR too.
std::vector<Comparison> comparisonsOf(const FlowFacts &facts) {
  const SyntaxTree &tree = *facts.file.tree;
  std::vector<Comparison> found;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    if (!test || !test->condition || !facts.isReached(node))
      continue;
    for (const ExpressionId id : subexpressions(tree, *test->condition)) {
      const auto *relation = as<BinaryOperation>(tree, id);
      if (relation && (relation->op == OperatorKind::Equal || relation->op == OperatorKind::NotEqual))
        found.push_back({node, relation, tree.expressions[id].span});
    }
  }
  return found;
}

/// Loops that end with the comparison: inexact-loop-end counts their iterations.
std::set<NodeId> endsOfLoops(const FlowFacts &facts) {
  std::set<NodeId> tests;
  for (const LoopFlow &loop : loopsOf(facts))
    if (loop.exitsAreKnown && loop.exits.size() == 1)
      tests.insert(loop.exits.front().test);
  return tests;
}

struct Compared {
  FormulaId left;
  FormulaId right;
  std::vector<FormulaInputId> inputs;
};

struct Difference {
  RoundedNumber left;
  RoundedNumber right;
};

/// Both sides are equal on paper, and the control computes two numbers.
std::optional<Difference> differenceFor(const Formulas &formulas, const Comparison &comparison,
                                        const Compared &compared, const FormulaSetting &setting) {
  const auto left = formulas.value(compared.left, setting);
  const auto right = formulas.value(compared.right, setting);
  const auto truth = left && right ? formulas.truth(comparison.relation->op, *left, *right) : std::nullopt;
  const bool isNear = truth && std::abs(left->computed - right->computed) < 1e-6;
  return isNear && truth->exact != truth->computed ? std::optional(Difference{*left, *right}) : std::nullopt;
}

/// Tries what the counter of a loop comes to, within the bounds of the loop.
std::optional<Difference> differenceIn(const Formulas &formulas, const Comparison &comparison, const Compared &compared,
                                       FormulaSetting &setting, std::int64_t most) {
  const auto counter =
      std::ranges::find_if(compared.inputs, [&](FormulaInputId id) { return formulas.input(id).counter.has_value(); });
  if (counter == compared.inputs.end())
    return differenceFor(formulas, comparison, compared, setting);
  const FormulaInput &input = formulas.input(*counter);
  std::optional<RoundedNumber> value = formulas.value(input.counter->start, setting);
  for (std::int64_t i = 0; value && i < most; ++i) {
    const bool isPossible = std::ranges::all_of(input.bounds, [&](const AbstractValue &bounds) {
      return bounds.mayBeNumber() && bounds.number().interval().contains(value->computed);
    });
    setting[counter->index()] = value;
    if (const auto found = isPossible ? differenceFor(formulas, comparison, compared, setting) : std::nullopt)
      return found;
    value = formulas.stepped(*input.counter, *value, setting);
  }
  return std::nullopt;
}

std::string describe(const Comparison &comparison, const Difference &difference, const FileContext &context) {
  const bool isLeft = difference.left.isInexact() && difference.left.computed != difference.left.exact.toDouble();
  const ExpressionId side = isLeft ? comparison.relation->left : comparison.relation->right;
  return describeRounding(context.quoted(context.tree.expressions[side].span),
                          isLeft ? difference.left : difference.right);
}

void report(const Formulas &formulas, const Comparison &comparison, const Compared &compared,
            const Difference &difference, const FormulaSetting &setting, const FileContext &context,
            const Reporter &reporter) {
  const std::string given = describeSetting(formulas, compared.inputs, setting);
  const bool isEqual = comparison.relation->op == OperatorKind::Equal;
  reporter.report(
      {.message = fmt::format("{}{}rounding makes {} {}: {}", given, given.empty() ? "" : ", ",
                              context.quoted(comparison.span), isEqual ? "false" : "true",
                              describe(comparison, difference, context)),
       .span = comparison.span,
       .flow = pathFromEntry(formulas.facts(), comparison.test),
       .notes = {"the control computes in binary numbers, of which none is 0.1 or 1/3: two results that are "
                 "equal on paper may differ in the last digit",
                 "compare with a margin that is smaller than any difference that matters"},
       .fixes = marginFixes(context, *comparison.relation, 1)},
      given.empty() ? Severity::Warning : Severity::Info);
}

/// SQRT, SIN and their like of a value that is not known, perhaps multiplied or added to: the digits of the result end
/// where the control cuts them.
std::optional<FunctionKind> inexactFunction(const FlowFacts &facts, ExpressionId expression, NodeId at, int depth = 0) {
  constexpr std::array kInexact = {FunctionKind::Sqrt, FunctionKind::Sin,  FunctionKind::Cos, FunctionKind::Tan,
                                   FunctionKind::Asin, FunctionKind::Acos, FunctionKind::Atan};
  constexpr int kDeepest = 8;
  const SyntaxTree &tree = *facts.file.tree;
  const ExpressionId id = unwrapped(tree, expression);
  const AbstractValue *value = facts.valueOf(id);
  if (depth > kDeepest || (value && value->isNumber() && value->number().isConstant()))
    return std::nullopt;
  if (const auto *call = as<FunctionCall>(tree, id))
    return std::ranges::find(kInexact, call->function) != kInexact.end() ? std::optional(call->function) : std::nullopt;
  if (const auto *operation = as<BinaryOperation>(tree, id)) {
    if (isRelation(operation->op) || isBitwise(operation->op))
      return std::nullopt;
    const auto left = inexactFunction(facts, operation->left, at, depth + 1);
    return left ? left : inexactFunction(facts, operation->right, at, depth + 1);
  }
  const auto variable = variableOf(facts, id);
  const auto known = variable ? definitionsOf(facts, *variable, at) : std::nullopt;
  if (!known || known->fromEntry || known->nodes.size() != 1)
    return std::nullopt;
  const auto assignment = assignmentTo(facts, known->nodes.front(), *variable);
  return assignment ? inexactFunction(facts, assignment->value, known->nodes.front(), depth + 1) : std::nullopt;
}

/// `IF[#5EQ#3]` behind `#5=SQRT[..]`.  Where it is compared with 0 it mostly asks for an argument that gives exactly 0;
/// COS of 90 does not.
void checkFunctions(const Comparison &comparison, const FlowFacts &facts, const FileContext &context,
                    const Reporter &reporter) {
  if (context.dialect.behaviour.equalTolerance != 0)
    return;
  const BinaryOperation &relation = *comparison.relation;
  for (const auto &[side, other] :
       {std::pair{relation.left, relation.right}, std::pair{relation.right, relation.left}}) {
    const auto function = isVacant(context, other) ? std::nullopt : inexactFunction(facts, side, comparison.test);
    const auto literal = literalValue(context.tree, other);
    const bool isZero = literal && literal->isZero();
    if (!function || (isZero && *function != FunctionKind::Cos))
      continue;
    return reporter.report(
        {.message = fmt::format("{} compares the result of {} to the last digit", context.quoted(comparison.span),
                                context.quoted(context.tree.expressions[side].span)),
         .span = comparison.span,
         .flow = pathFromEntry(facts, comparison.test),
         .notes = {fmt::format("the result of {} is rounded: it may differ in the last digit from a number that is "
                               "equal on paper",
                               spellingOf(*function)),
                   "compare with a margin that is smaller than any difference that matters"},
         .fixes = isZero ? std::vector<FixIt>{} : marginFixes(context, relation, 1)},
        isZero ? Severity::Info : Severity::Warning);
  }
}

void checkOne(const Comparison &comparison, const FlowFacts &facts, const FileContext &context,
              const Reporter &reporter) {
  Formulas formulas(facts);
  const auto left = formulas.of(comparison.relation->left, comparison.test);
  const auto right = left ? formulas.of(comparison.relation->right, comparison.test) : std::nullopt;
  if (!right)
    return checkFunctions(comparison, facts, context, reporter);
  std::set<FormulaInputId> all;
  for (const FormulaId side : {*left, *right})
    for (const FormulaInputId id : formulas.inputsOf(side))
      all.insert(id);
  const Compared compared{*left, *right, {all.begin(), all.end()}};
  const auto counters =
      std::ranges::count_if(compared.inputs, [&](FormulaInputId id) { return formulas.input(id).counter.has_value(); });
  if (counters > 1)
    return;
  const bool isKnown = static_cast<std::size_t>(counters) == compared.inputs.size();
  std::int64_t budget = 50'000;
  const auto guards = formulas.guardsOf(comparison.test);
  std::optional<Difference> difference;
  const auto setting = findSetting(formulas, compared.inputs, [&](FormulaSetting &tried) {
    const std::int64_t most = isKnown ? 10'000 : 100;
    if (budget <= 0 || (counters == 0 && !formulas.pass(guards, tried)))
      return false;
    difference = differenceIn(formulas, comparison, compared, tried, most);
    budget -= counters > 0 ? most / 4 : 1;
    return difference && formulas.pass(guards, tried);
  });
  if (setting)
    report(formulas, comparison, compared, *difference, *setting, context, reporter);
  else
    checkFunctions(comparison, facts, context, reporter);
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts))
    return;
  const auto comparisons = comparisonsOf(facts);
  if (comparisons.empty())
    return;
  const auto ends = endsOfLoops(facts);
  for (const Comparison &comparison : comparisons)
    if (!ends.contains(comparison.test))
      checkOne(comparison, facts, context, reporter);
}

} // namespace

extern const Rule inexactEquality;
const Rule inexactEquality{
    .info = {"inexact-equality", Category::Flow, Severity::Warning,
             "Reports `EQ` or `NE` of computed numbers that rounding decides otherwise than on paper."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::inexact_equality
