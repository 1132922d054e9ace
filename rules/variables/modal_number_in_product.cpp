// modal-number-in-product: `F[#4113*#4]`, and `#4113` is the number of the last M code.
#include "findings/rule/rule.h"
#include "rules/flow/system_variables.h"

#include <fmt/format.h>

#include <optional>
#include <string_view>

namespace feedhold::rules::modal_number_in_product {
namespace {

/// Numbers that only name something: nothing is as many times as large.
std::optional<std::string_view> meaningOf(const FileContext &context, std::uint32_t variable) {
  const VariableRange *range = findVariable(context.dialect, variable);
  if (!range || range->role != VariableRole::ModalWord)
    return std::nullopt;
  switch (variable - range->first + 1) { // #4101 is the first
  case 13: return "M code";
  case 14: return "sequence number";
  case 15: return "program number";
  default: return std::nullopt;
  }
}

void check(ExpressionId id, BlockId, const FileContext &context, const Reporter &reporter) {
  const auto *product = as<BinaryOperation>(context.tree, id);
  if (!product || product->op != OperatorKind::Multiply)
    return;
  for (const ExpressionId side : {product->left, product->right}) {
    const auto variable = variableNumber(context.tree, unwrapped(context.tree, side));
    const auto meaning = variable ? meaningOf(context, *variable) : std::nullopt;
    if (!meaning)
      continue;
    const Span span = context.tree.expressions[side].span;
    reporter.report({.message = fmt::format("{} is the number of the last {}, and is multiplied here",
                                            context.quoted(span), *meaning),
                     .span = span,
                     .notes = {"a feed that is computed from it is hundreds of times too large or too small",
                               "the spindle speed is `#4119`, the feed `#4109`"}});
  }
}

} // namespace

extern const Rule modalNumberInProduct;
const Rule modalNumberInProduct{.info = {"modal-number-in-product", Category::Variable, Severity::Warning,
                                         "Reports a product with the number of an M code, a block or a program."},
                                .hooks = {.expression = check, .expressionNodes = nodeSet<BinaryOperation>()}};

} // namespace feedhold::rules::modal_number_in_product
