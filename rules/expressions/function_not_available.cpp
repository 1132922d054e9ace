// function-not-available: `POW` on a control without it.
#include "base/support/text.h"
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>

namespace feedhold::rules::function_not_available {
namespace {

/// `SQR[..]` and `RND[..]`: short names that the control does not have.
std::string_view shortNameOf(ExpressionId id, const FunctionCall &call, const FileContext &context) {
  if (context.dialect.grammar.shortForms)
    return {};
  const std::string_view text = context.text(context.tree.expressions[id].span);
  const auto startsWith = [&](std::string_view name) {
    return text.size() > name.size() && toUpper(text.substr(0, name.size())) == name;
  };
  if (call.function == FunctionKind::Round && startsWith("RND"))
    return text.substr(0, 3);
  const bool isShort = call.function == FunctionKind::Sqrt && startsWith("SQR") && !startsWith("SQRT");
  return isShort ? text.substr(0, 3) : std::string_view{};
}

void check(ExpressionId id, BlockId, const FileContext &context, const Reporter &reporter) {
  const auto *call = as<FunctionCall>(context.tree, id);
  if (!call)
    return;
  if (const std::string_view name = shortNameOf(id, *call, context); !name.empty())
    return reporter.report(
        {.message = fmt::format("{} does not have the function `{}`", context.dialect.id, name),
         .span = context.tree.expressions[id].span,
         .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::FunctionNotUsable)),
                   fmt::format("write `{}`", spellingOf(call->function))}});
  if (findFunction(context.dialect, call->function))
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
