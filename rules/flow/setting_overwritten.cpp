// setting-overwritten: `#596=#4` in a macro whose caller has set `#596`, and passes no I.
#include "rules/flow/flow_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::setting_overwritten {
namespace {

/// `#596=#4` at the head of a macro: a common variable is set to an argument that nothing checks.
struct Transfer {
  BlockId block;
  const Assignment *assignment;
  std::uint32_t common;
  std::uint32_t argument;
};

bool isCommon(const FileContext &context, std::uint32_t variable) {
  const VariableRange *range = variable >= kFirstNamedVariable ? nullptr : findVariable(context.dialect, variable);
  return range && (range->kind == VariableKind::Common || range->kind == VariableKind::Retentive);
}

std::optional<Transfer> transferIn(const FlowFacts &facts, const FileContext &context, BlockId block,
                                   const Assignment &assignment) {
  const auto common = variableNumber(context.tree, unwrapped(context.tree, assignment.target));
  const auto argument = variableNumber(context.tree, unwrapped(context.tree, assignment.value));
  const bool isTransfer = common && argument && isCommon(context, *common) && isParameter(facts, *argument) &&
                          argumentBehind(facts, *argument) == argument;
  if (!isTransfer || isTested(facts.file, facts.program, *argument))
    return std::nullopt;
  return Transfer{block, &assignment, *common, *argument};
}

/// Up to the first block from which control may not go on to the next.
std::vector<Transfer> transfersOf(const FlowFacts &facts, const FileContext &context) {
  std::vector<Transfer> found;
  for (const BlockId block : blocksOf(facts.file, facts.program)) {
    if (flowAfter(context.tree, block, context.dialect) != FlowAfter::Next ||
        context.tree.blocks[block].has(Block::kSkip))
      break;
    for (const Statement &statement : context.tree.statementsOf(block))
      if (const auto *assignment = std::get_if<Assignment>(&statement.node))
        if (const auto transfer = transferIn(facts, context, block, *assignment))
          found.push_back(*transfer);
  }
  return found;
}

/// No word of the call passes the argument, and where the program works on the variables of its caller, that has not
/// set it.
bool passesNothing(const ProgramFile &file, const Call &call, std::uint32_t argument) {
  if (call.kind == CallKind::Macro)
    return std::ranges::none_of(call.arguments, [&](const Argument &each) { return each.variable == argument; });
  const auto isWritten = [&](const VariableUse &use) { return use.write && (!use.number || use.number == argument); };
  return call.kind == CallKind::Subprogram && !file.model->programs[call.caller].returns &&
         std::ranges::none_of(file.model->variablesOf(call.caller), isWritten);
}

/// The last assignment of a value to the variable before the call, in the text of the caller.
std::optional<Span> settingBefore(const ProgramFile &file, const Call &call, std::uint32_t variable) {
  std::optional<Span> setting;
  for (const VariableUse &use : file.model->variablesIn(file.model->programs[call.caller].first, call.block))
    if (use.write && use.number == variable)
      for (const Statement &statement : file.tree->statementsOf(use.block)) {
        const auto *assignment = std::get_if<Assignment>(&statement.node);
        if (assignment && variableNumber(*file.tree, assignment->target) == variable)
          setting = variableNumber(*file.tree, unwrapped(*file.tree, assignment->value)) == kVacantVariable
                        ? std::nullopt
                        : std::optional(statement.span);
      }
  return setting;
}

bool isReadBehind(const ProgramFile &file, BlockId first, BlockId last, std::uint32_t variable) {
  return std::ranges::any_of(file.model->variablesIn(first, last),
                             [&](const VariableUse &use) { return !use.write && use.number == variable; });
}

void tell(const Transfer &transfer, const CallGraph::Caller &caller, const FlowFacts &facts, const FileContext &context,
          const Reporter &reporter) {
  const ProgramFile &file = facts.programs.file(caller.file);
  const Call &call = file.model->calls[caller.call];
  const auto setting = settingBefore(file, call, transfer.common);
  const bool isUsed =
      isReadBehind(facts.file, transfer.block.next(), context.model.programs[facts.program].last, transfer.common) ||
      isReadBehind(file, call.block.next(), file.model->programs[call.caller].last, transfer.common);
  if (!setting || !isUsed)
    return;
  const Span span = cover(context.tree.expressions[transfer.assignment->target].span,
                          context.tree.expressions[transfer.assignment->value].span);
  reporter.report(
      {.message = fmt::format("{} makes `#{}` vacant, which the calling program has set", context.quoted(span),
                              transfer.common),
       .span = span,
       .labels = {{*setting, "set here", caller.file},
                  {call.span,
                   fmt::format("this call does not pass {}", describeVariable(context.dialect, transfer.argument)),
                   caller.file}},
       .notes = {"an argument that is not passed is vacant, and so is its copy",
                 fmt::format("pass the value in the call, or copy it only if `[#{} NE #0]`", transfer.argument)}});
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.behaviour.variablesMayBeVacant)
    return;
  const auto callers = context.callGraph.callers({context.file, facts.program});
  if (callers.empty())
    return;
  for (const Transfer &transfer : transfersOf(facts, context)) {
    const auto found = std::ranges::find_if(callers, [&](const CallGraph::Caller &caller) {
      const ProgramFile &file = facts.programs.file(caller.file);
      const Call &call = file.model->calls[caller.call];
      return passesNothing(file, call, transfer.argument) && settingBefore(file, call, transfer.common);
    });
    if (found != callers.end())
      tell(transfer, *found, facts, context, reporter);
  }
}

} // namespace

extern const Rule settingOverwritten;
const Rule settingOverwritten{
    .info = {"setting-overwritten", Category::Flow, Severity::Warning,
             "Reports a macro that replaces what its caller has set by an argument that is not passed."},
    .hooks = {.flow = check, .flowRuns = FlowRuns::All}};

} // namespace feedhold::rules::setting_overwritten
