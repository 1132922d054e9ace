// subprogram-without-arguments: M98 calls a macro that reads `#18`.
#include "rules/flow/flow_view.h"

#include <fmt/format.h>

namespace feedhold::rules::subprogram_without_arguments {
namespace {

/// The first argument that the called program relies on, and that is vacant in a call without arguments.
std::optional<Read> missingIn(const FlowFacts &facts, const ProgramFile &file, ProgramId program) {
  for (const Read &read : readsOf(file, program))
    if (read.number && isLocal(file, *read.number) && letterOfArgument(*file.dialect, *read.number) &&
        isNeverSet(facts, *read.number) && !isTestedForVacancy(file, program, *read.number))
      return read;
  return std::nullopt;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!isMainProgram(facts))
    return; // the caller's own arguments serve
  for (const CallFact &fact : facts.calls()) {
    const Call &call = context.model.calls[fact.call];
    const auto callee = context.callGraph.callee(context.file, call);
    if (call.kind != CallKind::Subprogram || !callee)
      continue;
    const ProgramFile &file = facts.programs.file(callee->file);
    const auto missing = missingIn(facts, file, callee->program);
    if (!missing)
      continue;
    const char letter = *letterOfArgument(*file.dialect, *missing->number);
    reporter.report({.message = fmt::format("{} reads `#{}` ({}), but M98 passes no arguments", toString(call.callee),
                                            *missing->number, letter),
                     .span = call.span,
                     .labels = {{file.tree->expressions[missing->expression].span, "vacant here", callee->file}},
                     .notes = {"a subprogram uses the local variables of its caller, and nothing sets this one",
                               fmt::format("call it with G65 and pass {}, or set `#{}` before the call", letter,
                                           *missing->number)}});
  }
}

} // namespace

extern const Rule subprogramWithoutArguments;
const Rule subprogramWithoutArguments{.info = {"subprogram-without-arguments", Category::Flow, Severity::Warning,
                                               "Reports an `M98` call of a macro that reads arguments."},
                                      .hooks = {.flow = check}};

} // namespace feedhold::rules::subprogram_without_arguments
