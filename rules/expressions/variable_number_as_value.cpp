// variable-number-as-value: `#1=[5203+#5220*20]` in the place of `#1=#[5203+#5220*20]`.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace feedhold::rules::variable_number_as_value {
namespace {

/// Work offsets lie twenty numbers apart: G54 from #5221, G54.1 P1 from #7001 or #14001.
constexpr std::int64_t kStep = 20;
bool beginsTable(const Decimal &number) {
  const auto isIn = [&](std::int64_t first, std::int64_t last) {
    return number >= Decimal(first, 0) && number <= Decimal(last, 0);
  };
  return isIn(5201, 5230) || isIn(6981, 7010) || isIn(13981, 14010);
}

bool isStep(const SyntaxTree &tree, ExpressionId id) {
  const auto *product = asInside<BinaryOperation>(tree, id);
  if (!product || product->op != OperatorKind::Multiply)
    return false;
  const auto isTwenty = [&](ExpressionId side) {
    const auto value = literalValue(tree, side);
    return value && *value == Decimal(kStep, 0);
  };
  return (isTwenty(product->left) && !isConstant(tree, product->right)) ||
         (isTwenty(product->right) && !isConstant(tree, product->left));
}

/// The number of a variable of a work offset and nothing else, as a sum.
bool isNumberOfOffset(const SyntaxTree &tree, ExpressionId id) {
  const auto terms = termsOf(tree, id);
  const auto begins = [&](const SumTerm &term) {
    const auto value = literalValue(tree, term.value);
    return value && !term.isMinus && beginsTable(*value);
  };
  return terms.size() == 2 && std::ranges::count_if(terms, begins) == 1 &&
         std::ranges::any_of(terms, [&](const SumTerm &term) { return isStep(tree, term.value); });
}

/// The variable stands in the number of another one, in the number of a block, or goes to another program.
bool servesAsNumber(const FileContext &context, Span variable) {
  const SyntaxTree &tree = context.tree;
  const auto names = [&](ExpressionId id) {
    const auto parts = subexpressions(tree, id);
    return std::ranges::any_of(
        parts, [&](ExpressionId part) { return sameText(context, tree.expressions[part].span, variable); });
  };
  for (ExpressionId id(0); id.index() < tree.expressions.size(); id = id.next())
    if (const auto *indirect = as<IndirectVariable>(tree, id); indirect && names(indirect->index))
      return true;
  const auto passes = [&](const Call &call) {
    return std::ranges::any_of(call.values, names) ||
           std::ranges::any_of(call.arguments, [&](const Argument &argument) {
             const Word &word = tree.words[argument.word];
             return word.form() == WordForm::Expression && names(word.expression());
           });
  };
  return std::ranges::any_of(context.model.calls, passes);
}

void check(const Statement &statement, BlockId, const FileContext &context, const Reporter &reporter) {
  const auto *assignment = std::get_if<Assignment>(&statement.node);
  if (!assignment || !isNumberOfOffset(context.tree, assignment->value))
    return;
  const Span target = context.tree.expressions[assignment->target].span;
  const Span value = context.tree.expressions[assignment->value].span;
  if (servesAsNumber(context, target))
    return;
  const bool isBracketed = context.text(value).starts_with('[');
  reporter.report({.message = fmt::format("{} is the number of a variable, not its value", context.quoted(value)),
                   .span = value,
                   .notes = {fmt::format("{} gets the number of a work offset, and nothing reads the variable of that "
                                         "number",
                                         context.quoted(target)),
                             "`#[..]` reads the variable"},
                   .fixes = {{.title = "insert `#`",
                              .edits = isBracketed ? std::vector<Edit>{{{value.begin, value.begin}, "#"}}
                                                   : std::vector<Edit>{{{value.begin, value.begin}, "#["},
                                                                       {{value.end, value.end}, "]"}}}}});
}

} // namespace

extern const Rule variableNumberAsValue;
const Rule variableNumberAsValue{
    .info = {"variable-number-as-value", Category::Expression, Severity::Warning,
             "Reports the number of a work offset variable that is computed, but never used to read the variable."},
    .hooks = {.statement = check}};

} // namespace feedhold::rules::variable_number_as_value
