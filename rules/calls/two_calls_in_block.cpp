// two-calls-in-block: `G65 P1 M98 P2`.
#include "findings/rule/rule.h"

#include "rules/calls/call_view.h"

#include <fmt/format.h>

namespace feedhold::rules::two_calls_in_block {
namespace {

bool counts(CallKind kind) { return namesProgram(kind) || kind == CallKind::Local; }

/// The call just before in the text, when it is in the same block.
const Call *callBefore(CallId id, const FileContext &context) {
  for (std::size_t i = id.index(); i-- > 0;) {
    const Call &before = context.model.calls[CallId(i)];
    if (before.block != context.model.calls[id].block)
      return nullptr;
    if (counts(before.kind))
      return &before;
  }
  return nullptr;
}

void check(CallId id, const FileContext &context, const Reporter &reporter) {
  const Call &call = context.model.calls[id];
  const Call *before = counts(call.kind) ? callBefore(id, context) : nullptr;
  if (!before)
    return;
  const AlarmKind alarm = isMacroCall(call.kind) ? AlarmKind::TwoMacroCalls : AlarmKind::TwoSubprogramCalls;
  const Span code = wordOf(context, call.code).span();
  reporter.report(
      {.message = fmt::format("{} is the second call in this block", context.quoted(code)),
       .span = code,
       .labels = {{wordOf(context, before->code).span(), "the first one"}},
       .notes = {fmt::format("the control {}", stopsWith(context.dialect, alarm)), "put each call in its own block"}});
}

} // namespace

extern const Rule twoCallsInBlock;
const Rule twoCallsInBlock{
    .info = {"two-calls-in-block", Category::Call, Severity::Error, "Reports a second call in one block."},
    .hooks = {.call = check}};

} // namespace feedhold::rules::two_calls_in_block
