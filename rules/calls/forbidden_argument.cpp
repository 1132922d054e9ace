// forbidden-argument: `G65 P9010 G1.`.
#include "findings/rule/rule.h"

#include "rules/calls/call_view.h"

#include <fmt/format.h>

namespace feedhold::rules::forbidden_argument {
namespace {

void check(CallId id, const FileContext &context, const Reporter &reporter) {
  const Call &call = context.model.calls[id];
  // G66.1 passes every word of a block on, G codes included.
  if (!isMacroCall(call.kind) || call.kind == CallKind::ModalEach)
    return;
  for (const Argument &argument : call.arguments) {
    if (argument.role != ArgumentRole::Forbidden)
      continue;
    const Word &word = wordOf(context, argument.word);
    reporter.report({.message = fmt::format("`{}` cannot pass an argument", word.address()),
                     .span = word.span(),
                     .labels = {{wordOf(context, call.code).span(), "the call"}},
                     .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::ArgumentAddress)),
                               "pass the value with another letter"}});
  }
}

} // namespace

extern const Rule forbiddenArgument;
const Rule forbiddenArgument{.info = {"forbidden-argument", Category::Call, Severity::Error,
                                      "Reports a word in a macro call whose address cannot pass an argument."},
                             .hooks = {.call = check}};

} // namespace feedhold::rules::forbidden_argument
