// unguarded-table-division: `#6/#11`, and `#11` comes from the tool table, where the cell may be 0.
#include "rules/flow/flow_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::unguarded_table_division {
namespace {

constexpr int kMostCopies = 4;

/// A cell of the control's tables that keeps 0 until somebody fills it in: by its number, or `#[2400+#3026]`.
bool isTableCell(const FileContext &context, ExpressionId id) {
  const auto isStored = [&](std::uint32_t number) {
    const VariableRange *range = findVariable(context.dialect, number);
    return range && range->kind == VariableKind::System && range->role == VariableRole::Stored;
  };
  if (const auto *indirect = as<IndirectVariable>(context.tree, id)) {
    for (const ExpressionId part : subexpressions(context.tree, indirect->index))
      if (const auto base = literalValue(context.tree, part); base && *base > Decimal(1000, 0) && base->isInteger())
        return isStored(static_cast<std::uint32_t>(base->toDouble()) + 1);
    return false;
  }
  const auto number = variableNumber(context.tree, id);
  return number && *number < kFirstNamedVariable && isStored(*number);
}

/// The only assignment to the variable; absent when there is none or another one, or its value is tested.
std::optional<ExpressionId> onlyValue(const FlowFacts &facts, std::uint32_t variable) {
  const SyntaxTree &tree = *facts.file.tree;
  if (isTested(facts.file, facts.program, variable))
    return std::nullopt;
  std::optional<ExpressionId> value;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    for (const Assignment &assignment : assignmentsOf(facts, node))
      if (variableNumber(tree, unwrapped(tree, assignment.target)) == variable) {
        if (value)
          return std::nullopt;
        value = assignment.value;
      }
  return value;
}

/// The cell that makes the expression 0 when it is 0: itself, a factor, or behind a variable.
std::optional<ExpressionId> cellBehind(const FlowFacts &facts, const FileContext &context, ExpressionId id,
                                       int copies) {
  const ExpressionId inner = unwrapped(context.tree, id);
  if (isTableCell(context, inner))
    return inner;
  if (const auto *product = as<BinaryOperation>(context.tree, inner)) {
    if (product->op != OperatorKind::Multiply && product->op != OperatorKind::Divide)
      return std::nullopt;
    if (const auto left = cellBehind(facts, context, product->left, copies))
      return left;
    return product->op == OperatorKind::Multiply ? cellBehind(facts, context, product->right, copies) : std::nullopt;
  }
  const auto variable = variableNumber(context.tree, inner);
  const auto value = variable && copies < kMostCopies ? onlyValue(facts, *variable) : std::nullopt;
  return value ? cellBehind(facts, context, *value, copies + 1) : std::nullopt;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  std::vector<ExpressionId> done;
  for (const AlarmFact &alarm : facts.alarms()) {
    if (alarm.kind != AlarmKind::DivideByZero || alarm.always || isTooLarge(facts))
      continue;
    const auto divisor = expressionAt(facts, facts.node(alarm.node).block, alarm.place);
    const auto cell = divisor ? cellBehind(facts, context, *divisor, 0) : std::nullopt;
    if (!cell || std::ranges::find(done, *cell) != done.end())
      continue;
    done.push_back(*cell);
    const Span span = context.tree.expressions[*cell].span;
    const std::string quoted = context.quoted(span);
    reporter.report({.message = fmt::format("divides by the table entry {}, which nothing checks for 0", quoted),
                     .span = alarm.place,
                     .labels = {{span, "read from a table of the control"}},
                     .notes = {fmt::format("an entry that nobody has filled in is 0: the control {}",
                                           stopsWith(context.dialect, AlarmKind::DivideByZero)),
                               "check for 0 first, and raise an alarm that names the table"}});
  }
}

} // namespace

extern const Rule unguardedTableDivision;
const Rule unguardedTableDivision{.info = {"unguarded-table-division", Category::Flow, Severity::Warning,
                                           "Reports a division by a table entry of the control (a tool offset, for "
                                           "example) that is never checked for 0."},
                                  .hooks = {.flow = check}};

} // namespace feedhold::rules::unguarded_table_division
