// cancel-without-modal-call: `G67` with no `G66` in force.
#include "findings/rule/rule.h"

#include "rules/calls/call_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::cancel_without_modal_call {
namespace {

bool hasModalCall(const ProgramModel &model, ProgramId program) {
  return std::ranges::any_of(model.calls, [&](const Call &call) {
    return call.caller == program && (call.kind == CallKind::Modal || call.kind == CallKind::ModalEach);
  });
}

/// A G66 before this one may come from a program that this one calls, or that calls it.
bool neighbourHasModalCall(const FileContext &context, ProgramId program) {
  for (const auto &[file, callId] : context.callGraph.callers({context.file, program})) {
    const ProgramModel &model = context.callGraph.model(file);
    if (hasModalCall(model, model.calls[callId].caller))
      return true;
  }
  return std::ranges::any_of(context.model.calls, [&](const Call &call) {
    const auto callee = call.caller == program ? context.callGraph.callee(context.file, call) : std::nullopt;
    return callee && hasModalCall(context.callGraph.model(callee->file), callee->program);
  });
}

/// A program that returns may have been called under a G66 that no file shows.
bool mayHaveUnknownCaller(const FileContext &context, ProgramId id) {
  if (context.callGraph.isCalled({context.file, id}))
    return false;
  const Program &program = context.model.programs[id];
  for (BlockId block = program.first; block < program.last; block = block.next())
    if (findCode(context.tree, block, context.dialect, CodeRole::Return))
      return true;
  return false;
}

void check(CallId id, const FileContext &context, const Reporter &reporter) {
  const Call &call = context.model.calls[id];
  if (call.kind != CallKind::ModalCancel || context.dialect.switches.g67 == Switch::On ||
      hasModalCall(context.model, call.caller) || neighbourHasModalCall(context, call.caller) ||
      mayHaveUnknownCaller(context, call.caller))
    return;
  const Span code = wordOf(context, call.code).span();
  reporter.report(
      {.message = fmt::format("{} with no modal call to cancel", context.quoted(code)),
       .span = code,
       .notes = {fmt::format("the control {}, unless {}", stopsWith(context.dialect, AlarmKind::NoModalCall),
                             context.dialect.hasFanucParameters ? "parameter 6000#0 (G67) is 1"
                                                                : "a setting of the machine allows it"),
                 "delete it, or add the missing G66"}});
}

} // namespace

extern const Rule cancelWithoutModalCall;
const Rule cancelWithoutModalCall{.info = {"cancel-without-modal-call", Category::Call, Severity::Warning,
                                           "Reports a `G67` in a program where no modal macro call can be active."},
                                  .hooks = {.call = check}};

} // namespace feedhold::rules::cancel_without_modal_call
