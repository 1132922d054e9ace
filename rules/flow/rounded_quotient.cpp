// rounded-quotient: `FUP[#21/#22]`, where 0.6/0.2 is 2.9999999.
#include "rules/flow/flow_view.h"

#include <cmath>
#include <fmt/format.h>

namespace feedhold::rules::rounded_quotient {
namespace {

/// The division whose result is cut to a whole number, as it is or as a size.
const BinaryOperation *quotientIn(const SyntaxTree &tree, ExpressionId argument) {
  if (const auto *call = asInside<FunctionCall>(tree, argument); call && call->function == FunctionKind::Abs)
    return call->arguments().empty() ? nullptr : quotientIn(tree, call->arguments().front());
  const auto *operation = asInside<BinaryOperation>(tree, argument);
  return operation && operation->op == OperatorKind::Divide ? operation : nullptr;
}

std::optional<double> constantAt(const FlowFacts &facts, ExpressionId id) {
  const AbstractValue *value = facts.valueOf(id);
  return value && value->isNumber() ? value->number().constantValue() : std::nullopt;
}

/// A quotient of two constants that should be whole and is cut to the whole number beside it.
std::optional<double> lostWhole(FunctionKind function, double dividend, double divisor) {
  const double quotient = dividend / divisor;
  const double whole = std::round(quotient);
  const double cut = function == FunctionKind::Fix ? std::floor(quotient) : std::ceil(quotient);
  constexpr double kRounding = 1e-9;
  return divisor != 0 && std::abs(quotient - whole) < kRounding && cut != whole ? std::optional(whole) : std::nullopt;
}

bool isWhole(const FlowFacts &facts, ExpressionId id) {
  const AbstractValue *value = facts.valueOf(id);
  return value && value->isNumber() && value->number().isWhole();
}

void checkBlock(BlockId block, const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (const ExpressionId id : expressionsOf(facts.file, block)) {
    const auto *call = as<FunctionCall>(context.tree, id);
    if (!call || (call->function != FunctionKind::Fix && call->function != FunctionKind::Fup) ||
        call->arguments().empty())
      continue;
    const auto *quotient = quotientIn(context.tree, call->arguments().front());
    if (!quotient || !facts.valueOf(id) || isWhole(facts, quotient->right))
      continue;
    const auto dividend = constantAt(facts, quotient->left);
    const auto divisor = constantAt(facts, quotient->right);
    const bool isKnown = dividend && divisor;
    const auto whole = isKnown ? lostWhole(call->function, *dividend, *divisor) : std::nullopt;
    if (isKnown && !whole)
      continue;
    const Span span = context.tree.expressions[id].span;
    reporter.report({.message = whole
                                    ? fmt::format("{} is off by one: the quotient should be {}, but rounding misses it",
                                                  context.quoted(span), *whole)
                                    : fmt::format("{} may be off by one when the quotient should be a whole number",
                                                  context.quoted(span)),
                     .span = span,
                     .notes = {"the control computes in binary: 0.6/0.2 may come out just above or below 3, and FIX or "
                               "FUP is then off by one",
                               "add or subtract a small amount inside the brackets, or use ROUND"}},
                    whole ? Severity::Warning : Severity::Info);
  }
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  std::optional<BlockId> last;
  for (const VariableUse &use : context.model.variablesOf(facts.program)) {
    if (last == use.block)
      continue;
    last = use.block;
    checkBlock(use.block, facts, context, reporter);
  }
}

} // namespace

extern const Rule roundedQuotient;
const Rule roundedQuotient{.info = {"rounded-quotient", Category::Flow, Severity::Info,
                                    "Reports `FIX` or `FUP` of a quotient that may not be exact."},
                           .hooks = {.flow = check}};

} // namespace feedhold::rules::rounded_quotient
