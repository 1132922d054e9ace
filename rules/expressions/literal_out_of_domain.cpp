// literal-out-of-domain: `SQRT[-1]`, `ASIN[2]`, `LN[0]`.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include <fmt/format.h>

namespace feedhold::rules::literal_out_of_domain {
namespace {

const Decimal kOne = Decimal::fromInteger(1);

bool isPole(const Decimal &degrees) {
  const auto whole = degrees.asInteger();
  return whole && *whole % 90 == 0 && *whole % 180 != 0;
}

/// What is wrong with the argument; empty when nothing is.
std::string_view complaint(FunctionDomain domain, const Decimal &value) {
  switch (domain) {
  case FunctionDomain::Any:
  case FunctionDomain::Exponent: return {};
  case FunctionDomain::NotNegative: return value.isNegative() ? "accepts no negative numbers" : "";
  case FunctionDomain::Bcd: return value.isNegative() ? "accepts no negative numbers" : "";
  case FunctionDomain::Positive: return value <= Decimal() ? "accepts only numbers above 0" : "";
  case FunctionDomain::MinusOneToOne:
    return value > kOne || value.negated() > kOne ? "accepts only numbers from -1 to 1" : "";
  case FunctionDomain::NotPole: return isPole(value) ? "is not defined at odd multiples of 90 degrees" : "";
  }
  return {};
}

void check(ExpressionId id, BlockId, const FileContext &context, const Reporter &reporter) {
  const auto *call = as<FunctionCall>(context.tree, id);
  const Function *function =
      call && call->arguments().size() == 1 ? findFunction(context.dialect, call->function) : nullptr;
  const auto value = function ? literalValue(context.tree, call->arguments().front()) : std::nullopt;
  const std::string_view wrong = value ? complaint(function->domain, *value) : std::string_view();
  if (wrong.empty())
    return;
  reporter.report(
      {.message = fmt::format("`{}` {}", spellingOf(call->function), wrong),
       .span = context.tree.expressions[id].span,
       .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::ArgumentOutOfDomain))}});
}

} // namespace

extern const Rule literalOutOfDomain;
const Rule literalOutOfDomain{.info = {"literal-out-of-domain", Category::Expression, Severity::Error,
                                       "Reports a function of a number for which it has no value, such as `SQRT[-1]`."},
                              .hooks = {.expression = check, .expressionNodes = nodeSet<FunctionCall>()}};

} // namespace feedhold::rules::literal_out_of_domain
