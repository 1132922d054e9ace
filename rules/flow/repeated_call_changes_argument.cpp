// repeated-call-changes-argument: `G65P9010L3A5.` and the macro counts `#1` up.
#include "rules/flow/flow_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::repeated_call_changes_argument {
namespace {

/// An assignment that computes the new value from the old one.
std::optional<Span> updateOf(const ProgramFile &file, ProgramId program, std::uint32_t variable) {
  for (const VariableUse &use : file.model->variablesOf(program)) {
    if (!use.write || use.number != variable)
      continue;
    for (const Statement &statement : file.tree->statementsOf(use.block))
      if (const auto *assignment = std::get_if<Assignment>(&statement.node);
          assignment && assignment->target == use.expression &&
          std::ranges::any_of(readsIn(file, assignment->value, use.block),
                              [&](const Read &read) { return read.number == variable; }))
        return file.tree->expressions[use.expression].span;
  }
  return std::nullopt;
}

/// Set from something else before that: the old value does not matter.
bool isSetAfresh(const ProgramFile &file, ProgramId program, std::uint32_t variable) {
  for (const Read &read : readsOf(file, program))
    if (read.number == variable) {
      const auto uses = file.model->variablesOf(program);
      const auto write =
          std::ranges::find_if(uses, [&](const VariableUse &use) { return use.write && use.number == variable; });
      return write != uses.end() && write->block < read.block;
    }
  return true;
}

void check(CallId id, const FileContext &context, const Reporter &reporter) {
  const Call &call = context.model.calls[id];
  const auto callee = context.callGraph.callee(context.file, call);
  if (call.kind != CallKind::Macro || call.repeats.value_or(1) < 2 || !callee)
    return;
  const ProgramFile &file = context.programs->file(callee->file);
  for (const Argument &argument : call.arguments) {
    if (argument.role != ArgumentRole::Passed || argument.variable == 0 ||
        isSetAfresh(file, callee->program, argument.variable))
      continue;
    const auto update = updateOf(file, callee->program, argument.variable);
    if (!update)
      continue;
    reporter.report(
        {.message = fmt::format("this call repeats a macro that changes its argument `#{}`", argument.variable),
         .span = call.span,
         .labels = {{*update, "changed here", callee->file}},
         .notes = {"controls differ: the second call may start with the argument or with the changed value",
                   "copy the argument to another variable in the macro, or call the macro in a loop"}});
    return;
  }
}

void asksForPrograms(const FlowFacts &, const FileContext &, const Reporter &) {}

} // namespace

extern const Rule repeatedCallChangesArgument;
const Rule repeatedCallChangesArgument{
    .info = {"repeated-call-changes-argument", Category::Flow, Severity::Warning,
             "Reports a repeated macro call (`L2` and up) of a macro that changes its arguments."},
    .hooks = {.call = check, .flow = asksForPrograms}};

} // namespace feedhold::rules::repeated_call_changes_argument
