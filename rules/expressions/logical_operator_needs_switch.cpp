// logical-operator-needs-switch: comparisons joined while MLG is not known to be on.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include <fmt/format.h>

namespace feedhold::rules::logical_operator_needs_switch {
namespace {

bool isComparison(const SyntaxTree &tree, ExpressionId id) {
  const auto *operation = asInside<BinaryOperation>(tree, id);
  return operation && (isRelation(operation->op) || (isBitwise(operation->op) && isComparison(tree, operation->left)));
}

/// The outermost operator that joins two comparisons.
const BinaryOperation *joint(const SyntaxTree &tree, ExpressionId condition) {
  const auto *operation = asInside<BinaryOperation>(tree, condition);
  const bool joins = operation && isBitwise(operation->op) && isComparison(tree, operation->left) &&
                     isComparison(tree, operation->right);
  return joins ? operation : nullptr;
}

void check(const Statement &statement, BlockId, const FileContext &context, const Reporter &reporter) {
  const Switch setting = context.dialect.switches.mlg;
  const auto condition = conditionOf(statement);
  const BinaryOperation *found = condition && setting != Switch::On ? joint(context.tree, *condition) : nullptr;
  if (!found)
    return;
  const bool off = setting == Switch::Off;
  reporter.report(
      {.message = fmt::format("`{}` joins two comparisons, which needs {}", spellingOf(found->op),
                              context.dialect.hasFanucParameters ? "parameter 6006#0 (MLG)"
                                                                 : "a setting that not every machine has"),
       .span = found->opSpan,
       .notes = {off ? fmt::format("it is off: the control {}", stopsWith(context.dialect, AlarmKind::ExpressionFormat))
                     : std::string("where it is off, the control reads a bit operation and stops"),
                 off ? "write two IF blocks: for OR, two jumps to one target; for AND, two jumps past it on the "
                       "opposite conditions"
                     : "set `mlg` in feedhold.toml to the machine's setting"}},
      off ? Severity::Error : Severity::Info);
}

} // namespace

extern const Rule logicalOperatorNeedsSwitch;
const Rule logicalOperatorNeedsSwitch{.info = {"logical-operator-needs-switch", Category::Expression, Severity::Info,
                                               "Reports `AND`, `OR` or `XOR` between two comparisons where parameter "
                                               "6006#0 (MLG), which allows it, is off or not known."},
                                      .hooks = {.statement = check}};

} // namespace feedhold::rules::logical_operator_needs_switch
