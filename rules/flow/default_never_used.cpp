// default-never-used: `IF[#13GT3.1]GOTO2`, `#13=3.1`, and nothing behind it reads `#13`.
#include "rules/flow/flow_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace feedhold::rules::default_never_used {
namespace {

/// The text of the program says what it reads of its local variables, and no caller sees them.
bool isTransparent(const FlowFacts &facts) {
  const ProgramFile &file = facts.file;
  return !isCalledAsSubprogram(facts) && std::ranges::all_of(file.model->callsOf(facts.program), [](const Call &call) {
    return call.kind == CallKind::Macro || call.kind == CallKind::Modal || call.kind == CallKind::ModalCancel;
  }) && std::ranges::none_of(file.model->variablesOf(facts.program), [&](const VariableUse &use) {
    return mayReadLocal(file, use);
  });
}

/// `IF[#13EQ#0]THEN#13=5.`, or `IF[#13GT3.1]GOTO2` in front of the block that sets it.
bool decidesOnlyItself(const FileContext &context, BlockId block, std::uint32_t variable, BlockId end) {
  const auto setsIt = [&](BlockId each) {
    return std::ranges::any_of(context.model.variablesIn(each, each.next()),
                               [&](const VariableUse &use) { return use.write && use.number == variable; });
  };
  const Statement *statement = firstStatement(context.tree, block);
  const auto *branch = statement ? std::get_if<If>(&statement->node) : nullptr;
  if (!branch)
    return false;
  if (branch->action == IfAction::Statement)
    return setsIt(block);
  BlockId next = block.next();
  while (next < end && isEmpty(context.tree, next))
    next = next.next();
  return next < end && setsIt(next);
}

/// Where the variable is set, if all its reads only decide that.
std::optional<Span> onlySetting(const FlowFacts &facts, const FileContext &context, std::uint32_t variable) {
  const BlockId end = context.model.programs[facts.program].last;
  std::optional<Span> setting;
  bool isRead = false;
  for (const VariableUse &use : context.model.variablesOf(facts.program)) {
    if (use.number != variable)
      continue;
    if (use.write)
      setting = setting ? setting : context.tree.expressions[use.expression].span;
    else if (!decidesOnlyItself(context, use.block, variable, end))
      return std::nullopt;
    else
      isRead = true;
  }
  return isRead ? setting : std::nullopt;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.grammar.oWords || isMainProgram(facts) || !context.model.programs[facts.program].returns ||
      !isTransparent(facts))
    return;
  for (std::uint32_t variable = 1; variable <= kLocalVariables; ++variable) {
    const auto setting =
        letterOfArgument(context.dialect, variable) ? onlySetting(facts, context, variable) : std::nullopt;
    if (!setting)
      continue;
    reporter.report({.message = fmt::format("{} gets a default or a limit here, and nothing uses it",
                                            describeVariable(context.dialect, variable)),
                     .span = *setting,
                     .notes = {"whatever the call passes for it, the macro does the same",
                               "use it where it is meant to decide, or delete it"}});
  }
}

} // namespace

extern const Rule defaultNeverUsed;
const Rule defaultNeverUsed{.info = {"default-never-used", Category::Flow, Severity::Warning,
                                     "Reports an argument that is given a default or a limit, and that nothing uses."},
                            .hooks = {.flow = check, .flowRuns = FlowRuns::All}};

} // namespace feedhold::rules::default_never_used
