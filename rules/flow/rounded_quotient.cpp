// rounded-quotient: `FUP[#21/#22]`, where 0.6/0.2 is 2.9999999.
#include "rules/flow/flow_view.h"

#include <cmath>
#include <fmt/format.h>

namespace feedhold::rules {
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
    reporter.report(
        {.message = whole
                        ? fmt::format("{} is off by one: the quotient should be {} and is computed beside it",
                                      context.quoted(span), *whole)
                        : fmt::format("{} may be off by one where the quotient should be whole", context.quoted(span)),
         .span = span,
         .notes = {"0.6/0.2 need not be 3: decimal fractions have no exact value in the control, and FIX and FUP "
                   "go to the whole number beside it",
                   "add or subtract a small amount within the brackets, or ROUND"}},
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
                                    "Reports FIX and FUP of a quotient that need not be exact."},
                           .hooks = {.flow = check}};

} // namespace feedhold::rules
