// The words of calls.
#include "rules/calls/call_view.h"

#include <algorithm>

namespace feedhold::rules {

bool namesProgram(CallKind kind) {
  switch (kind) {
  case CallKind::Macro:
  case CallKind::Modal:
  case CallKind::ModalEach:
  case CallKind::Subprogram:
  case CallKind::External: return true;
  case CallKind::ModalCancel:
  case CallKind::MacroA:
  case CallKind::Local:
  case CallKind::OWord:
  case CallKind::Code: return false;
  }
  return false;
}

bool isMacroCall(CallKind kind) {
  return kind == CallKind::Macro || kind == CallKind::Modal || kind == CallKind::ModalEach;
}

const Word &wordOf(const FileContext &context, WordId id) { return context.tree.words[id]; }

const Call *callTo(const FileContext &context, ProgramId caller, ProgramRef callee) {
  const auto calls = context.model.callsOf(caller);
  const auto found = std::ranges::find_if(
      calls, [&](const Call &call) { return context.callGraph.callee(context.file, call) == callee; });
  return found == calls.end() ? nullptr : &*found;
}

} // namespace feedhold::rules
