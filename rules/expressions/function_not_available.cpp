// function-not-available: `POW` on a control without it.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include <fmt/format.h>

namespace feedhold::rules::function_not_available {
namespace {

void check(ExpressionId id, BlockId, const FileContext &context, const Reporter &reporter) {
  const auto *call = as<FunctionCall>(context.tree, id);
  if (!call || findFunction(context.dialect, call->function))
    return;
  reporter.report(
      {.message = fmt::format("{} does not have the function `{}`", context.dialect.id, spellingOf(call->function)),
       .span = context.tree.expressions[id].span,
       .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::FunctionNotUsable)),
                 "compute the value another way"}});
}

} // namespace

extern const Rule functionNotAvailable;
const Rule functionNotAvailable{.info = {"function-not-available", Category::Expression, Severity::Error,
                                         "Reports a function that the control does not have."},
                                .hooks = {.expression = check, .expressionNodes = nodeSet<FunctionCall>()}};

} // namespace feedhold::rules::function_not_available
