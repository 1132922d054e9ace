// modal-call-not-cancelled: `G66` and no `G67`.
#include "findings/rule/rule.h"

#include "rules/calls/call_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::modal_call_not_cancelled {
namespace {

bool isModal(CallKind kind) { return kind == CallKind::Modal || kind == CallKind::ModalEach; }

bool cancels(const ProgramModel &model, ProgramId program) {
  return std::ranges::any_of(model.callsOf(program),
                             [](const Call &call) { return call.kind == CallKind::ModalCancel; });
}

/// Who calls this program may cancel what it leaves in force.
bool callerCancels(const FileContext &context, ProgramId program) {
  return std::ranges::any_of(context.callGraph.callers({context.file, program}), [&](const CallGraph::Caller &caller) {
    const ProgramModel &model = context.callGraph.model(caller.file);
    return cancels(model, model.calls[caller.call].caller);
  });
}

/// The last G66 of the program with no G67 behind it.
const Call *leftInForce(const FileContext &context, ProgramId program) {
  const Call *last = nullptr;
  for (const Call &call : context.model.callsOf(program)) {
    if (isModal(call.kind))
      last = &call;
    else if (call.kind == CallKind::ModalCancel)
      last = nullptr;
  }
  return last;
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  const Call *call = leftInForce(context, program);
  if (!call || callerCancels(context, program))
    return;
  reporter.report(
      {.message = fmt::format("{} is never cancelled", context.quoted(call->span)),
       .span = call->span,
       .notes = {"every later move calls the macro again, including the retract and the move to the tool change",
                 "cancel it with G67"}});
}

} // namespace

extern const Rule modalCallNotCancelled;
const Rule modalCallNotCancelled{.info = {"modal-call-not-cancelled", Category::Call, Severity::Warning,
                                          "Reports a modal macro call (`G66`) without a later `G67`."},
                                 .hooks = {.program = check}};

} // namespace feedhold::rules::modal_call_not_cancelled
