// too-many-ijk-sets: the eleventh I.
#include "findings/rule/rule.h"

#include "rules/calls/call_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::too_many_ijk_sets {
namespace {

void check(CallId id, const FileContext &context, const Reporter &reporter) {
  const Call &call = context.model.calls[id];
  const auto beyond = std::ranges::find(call.arguments, ArgumentRole::BeyondSets, &Argument::role);
  if (beyond == call.arguments.end())
    return;
  const Span span = wordOf(context, beyond->word).span();
  reporter.report({.message = fmt::format("{} begins one set of I, J, K too many; the limit is {}",
                                          context.quoted(span), context.dialect.limits.ijkSets),
                   .span = span,
                   .labels = {{wordOf(context, call.code).span(), "the call"}},
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::TooManyIjkSets)),
                             "pass the remaining values in common variables, or call the macro twice"}});
}

} // namespace

extern const Rule tooManyIjkSets;
const Rule tooManyIjkSets{
    .info = {"too-many-ijk-sets", Category::Call, Severity::Error,
             "Reports a macro call with more sets of I, J, K than the control has variables for."},
    .hooks = {.call = check}};

} // namespace feedhold::rules::too_many_ijk_sets
