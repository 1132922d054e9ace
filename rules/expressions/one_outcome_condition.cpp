// one-outcome-condition: `IF[[#1NE1]OR[#1NE2]]`.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"
#include "rules/flow/system_variables.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace feedhold::rules::one_outcome_condition {
namespace {

/// A value that the variable may have; absent: vacant.
using Sample = std::optional<double>;

struct Comparison {
  OperatorKind op;
  ExpressionId variable;
  Sample limit; // absent: `#0`
};

/// Between two reads of one condition.
bool mayChange(const FileContext &context, ExpressionId value) {
  if (!readsLiveValue(context, value))
    return false;
  const auto number = variableNumber(context.tree, unwrapped(context.tree, value));
  const VariableRole role = number ? roleOf(context, *number) : VariableRole::Volatile;
  return role != VariableRole::ModalCode && role != VariableRole::ModalWord && !isPosition(role) &&
         (!number || !isOffset(context, *number));
}

OperatorKind mirrored(OperatorKind op) {
  if (op == OperatorKind::GreaterThan)
    return OperatorKind::LessThan;
  if (op == OperatorKind::GreaterOrEqual)
    return OperatorKind::LessOrEqual;
  if (op == OperatorKind::LessThan)
    return OperatorKind::GreaterThan;
  return op == OperatorKind::LessOrEqual ? OperatorKind::GreaterOrEqual : op;
}

std::optional<Comparison> comparisonIn(const FileContext &context, const BinaryOperation &relation) {
  const auto limitOf = [&](ExpressionId side) -> std::optional<Sample> {
    if (const auto value = literalValue(context.tree, side))
      return Sample(value->toDouble());
    if (isVacant(context, side))
      return std::optional<Sample>(std::in_place); // not the same as no limit
    return std::nullopt;
  };
  const auto isVariable = [&](ExpressionId side) {
    return !isConstant(context.tree, side) && !isVacant(context, side) && !mayChange(context, side);
  };
  const auto left = limitOf(relation.left);
  const auto right = limitOf(relation.right);
  if (right && isVariable(relation.left))
    return Comparison{relation.op, unwrapped(context.tree, relation.left), *right};
  if (left && isVariable(relation.right))
    return Comparison{mirrored(relation.op), unwrapped(context.tree, relation.right), *left};
  return std::nullopt;
}

/// As the control compares: EQ and NE tell vacant from 0, the others take it as 0.
bool holds(const Comparison &comparison, Sample value) {
  if (comparison.op == OperatorKind::Equal || comparison.op == OperatorKind::NotEqual)
    return (value == comparison.limit) == (comparison.op == OperatorKind::Equal);
  const double number = value.value_or(0);
  const double limit = comparison.limit.value_or(0);
  if (number == limit)
    return comparison.op == OperatorKind::GreaterOrEqual || comparison.op == OperatorKind::LessOrEqual;
  const bool wantsGreater = comparison.op == OperatorKind::GreaterThan || comparison.op == OperatorKind::GreaterOrEqual;
  return wantsGreater == (number > limit);
}

bool joins(OperatorKind op) { return op == OperatorKind::And || op == OperatorKind::Or; }

/// A condition of comparisons of one variable, or one expression, with constants, joined by AND and OR.  Others may
/// stand beside them: their outcome is taken to be any.
class Combination {
public:
  /// `own`: whose comparisons are looked at.
  Combination(const FileContext &context, ExpressionId root, const std::vector<Comparison> &own)
      : context_(context), root_(root), own_(own) {}

  /// Absent: it depends on values.
  std::optional<bool> outcome() const {
    const std::optional<bool> first = evaluate(root_, Sample(0));
    for (const Sample &sample : samples())
      if (!first || evaluate(root_, sample) != first)
        return std::nullopt;
    return first;
  }

private:
  bool isOwn(const Comparison &comparison) const {
    return std::ranges::any_of(own_, [&](const Comparison &each) { return each.variable == comparison.variable; });
  }

  /// Absent: the outcome of another comparison decides.
  std::optional<bool> evaluate(ExpressionId id, Sample value) const {
    const auto *operation = asInside<BinaryOperation>(context_.tree, id);
    if (!operation)
      return std::nullopt;
    if (!joins(operation->op)) {
      const auto comparison = isRelation(operation->op) ? comparisonIn(context_, *operation) : std::nullopt;
      return comparison && isOwn(*comparison) ? std::optional(holds(*comparison, value)) : std::nullopt;
    }
    const auto left = evaluate(operation->left, value);
    const auto right = evaluate(operation->right, value);
    const bool decisive = operation->op == OperatorKind::Or;
    if (left == decisive || right == decisive)
      return decisive;
    return left && right ? std::optional(!decisive) : std::nullopt;
  }

  /// The limits, a value between any two of them, one beyond each end, and vacant.
  std::vector<Sample> samples() const {
    std::vector<double> limits;
    for (const Comparison &comparison : own_)
      limits.push_back(comparison.limit.value_or(0));
    std::ranges::sort(limits);
    std::vector<Sample> all{limits.front() - 1, limits.back() + 1};
    if (context_.dialect.behaviour.variablesMayBeVacant)
      all.emplace_back();
    for (std::size_t i = 0; i < limits.size(); ++i) {
      all.emplace_back(limits[i]);
      if (i > 0)
        all.emplace_back((limits[i - 1] + limits[i]) / 2);
    }
    return all;
  }

  const FileContext &context_;
  ExpressionId root_;
  const std::vector<Comparison> &own_;
};

/// The comparisons of one variable, for each variable.
std::vector<std::vector<Comparison>> comparisonsIn(const FileContext &context, ExpressionId root) {
  std::vector<std::vector<Comparison>> groups;
  const auto spanOf = [&](const Comparison &comparison) { return context.tree.expressions[comparison.variable].span; };
  std::vector<ExpressionId> open{root};
  while (!open.empty()) {
    const auto *operation = asInside<BinaryOperation>(context.tree, open.back());
    open.pop_back();
    if (!operation)
      continue;
    if (joins(operation->op)) {
      open.insert(open.end(), {operation->right, operation->left});
      continue;
    }
    const auto comparison = isRelation(operation->op) ? comparisonIn(context, *operation) : std::nullopt;
    if (!comparison)
      continue;
    const auto group = std::ranges::find_if(groups, [&](const std::vector<Comparison> &each) {
      return sameText(context, spanOf(each.front()), spanOf(*comparison));
    });
    if (group == groups.end())
      groups.push_back({*comparison});
    else
      group->push_back(*comparison);
  }
  return groups;
}

/// By the comparisons of one variable; absent: it depends on values.
std::optional<bool> outcomeOf(const FileContext &context, ExpressionId condition) {
  for (const std::vector<Comparison> &own : comparisonsIn(context, condition))
    if (own.size() > 1)
      if (const auto outcome = Combination(context, condition, own).outcome())
        return outcome;
  return std::nullopt;
}

/// Of `o1 if`, `o1 elseif` and `o1 while`, too.
std::optional<ExpressionId> anyConditionOf(const Statement &statement, const SyntaxTree &tree) {
  const auto *oWord = std::get_if<OWord>(&statement.node);
  if (!oWord)
    return conditionOf(statement);
  const bool asks = oWord->kind == OWordKind::If || oWord->kind == OWordKind::ElseIf || oWord->kind == OWordKind::While;
  const auto arguments = tree.argumentsOf(*oWord);
  return asks && !arguments.empty() ? std::optional(arguments.front()) : std::nullopt;
}

void check(const Statement &statement, BlockId, const FileContext &context, const Reporter &reporter) {
  const auto condition = anyConditionOf(statement, context.tree);
  if (!condition)
    return;
  const auto outcome = outcomeOf(context, *condition);
  if (!outcome)
    return;
  const Span span = context.tree.expressions[*condition].span;
  reporter.report(
      {.message = fmt::format("{} is {} for every value", context.quoted(span), *outcome ? "true" : "false"),
       .span = span,
       .notes = {*outcome ? "every value fulfils one of the comparisons that `OR` joins"
                          : "no value fulfils all comparisons that `AND` joins",
                 *outcome ? "join them with `AND`, or correct the limits"
                          : "join them with `OR`, or correct the limits"}});
}

} // namespace

extern const Rule oneOutcomeCondition;
const Rule oneOutcomeCondition{.info = {"one-outcome-condition", Category::Expression, Severity::Warning,
                                        "Reports comparisons of one variable, joined by `AND` or `OR`, that have one "
                                        "outcome for every value."},
                               .hooks = {.statement = check}};

} // namespace feedhold::rules::one_outcome_condition
