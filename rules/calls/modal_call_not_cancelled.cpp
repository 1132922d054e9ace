// modal-call-not-cancelled: `G66` and no `G67`, or the same `G66` once more.
#include "findings/rule/rule.h"

#include "rules/calls/call_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

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

/// The same macro is called modally again before G67, on the only way that the text shows.
void checkRepeated(ProgramId program, const FileContext &context, const Reporter &reporter) {
  const std::set<BlockId> targets = context.model.jumpTargetsOf(program);
  const Call *active = nullptr;
  for (const Call &call : context.model.callsOf(program)) {
    const bool isSame = active && isModal(call.kind) && call.kind == active->kind && !call.callee.empty() &&
                        call.callee == active->callee;
    const auto target = active ? targets.upper_bound(active->block) : targets.end();
    if (isSame && (target == targets.end() || *target > call.block))
      reporter.report(
          {.message = fmt::format("{} is called modally again before `G67`", context.quoted(call.span)),
           .span = call.span,
           .labels = {{active->span, "still active"}},
           .notes = {"modal calls nest: each move calls the macro, and each move of the macro calls it once more",
                     "cancel the first call with G67 before the second"}});
    active = isModal(call.kind) ? &call : nullptr;
  }
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.hasFanucParameters)
    checkRepeated(program, context, reporter);
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
const Rule modalCallNotCancelled{
    .info = {"modal-call-not-cancelled", Category::Call, Severity::Warning,
             "Reports a modal macro call (`G66`) without a later `G67`, or again before it."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::modal_call_not_cancelled
