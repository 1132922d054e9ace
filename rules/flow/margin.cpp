// Half the least increment of a metric program is far above rounding errors, and no machine moves by it.
#include "rules/flow/margin.h"

#include <fmt/format.h>

namespace feedhold::rules {
namespace {

constexpr double kMargin = 0.0005;
constexpr std::string_view kMarginText = ".0005";

std::string nearness(const FileContext &context, const BinaryOperation &relation) {
  const auto text = [&](ExpressionId id) {
    const ExpressionId inner = unwrapped(context.tree, id);
    const std::string written(context.text(context.tree.expressions[inner].span));
    return as<BinaryOperation>(context.tree, inner) ? "[" + written + "]" : written;
  };
  return fmt::format("ABS[{}-{}]{}{}", text(relation.left), text(relation.right),
                     relation.op == OperatorKind::Equal ? "LT" : "GE", kMarginText);
}

} // namespace

std::vector<FixIt> marginFixes(const FileContext &context, const BinaryOperation &relation, double apart) {
  if (apart < 2 * kMargin)
    return {};
  const Span left = context.tree.expressions[relation.left].span;
  const Span limit = context.tree.expressions[relation.right].span;
  if (relation.op == OperatorKind::Equal || relation.op == OperatorKind::NotEqual) {
    std::string text = nearness(context, relation);
    return {{.title = fmt::format("write `{}`", text), .edits = {{cover(left, limit), std::move(text)}}}};
  }
  const bool isLower = relation.op == OperatorKind::LessThan || relation.op == OperatorKind::GreaterOrEqual;
  std::string text = fmt::format("[{}{}{}]", context.text(limit), isLower ? "-" : "+", kMarginText);
  return {{.title = fmt::format("compare with `{}`", text), .edits = {{limit, std::move(text)}}}};
}

} // namespace feedhold::rules
