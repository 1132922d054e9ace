// second-call-with-last-tool: `M97 P270` twice, and N270 cuts before it changes to the next tool.
#include "rules/motion/tool_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace feedhold::rules::second_call_with_last_tool {
namespace {

/// What a subprogram does with tools: it cuts, and changes the tool behind that.
struct Work {
  const Word *cut;
  const Word *change;
};

bool changesTool(BlockId block, const FileContext &context) {
  return findWord(context.tree, block, 'T') ||
         findAction(context.tree, block, context.dialect, {CodeAction::ToolChange}) != nullptr;
}

/// Absent where the tool of the first cut is not that of the caller.
std::optional<Work> workOf(BlockId first, BlockId last, const FileContext &context) {
  Work work{};
  for (BlockId block = first; block < last; block = block.next()) {
    if (!context.model.callsIn(block, block.next()).empty() || !context.tree.statementsOf(block).empty())
      return std::nullopt; // something else may change the tool
    if (changesTool(block, context)) {
      if (!work.cut)
        return std::nullopt;
      work.change = findAction(context.tree, block, context.dialect, {CodeAction::ToolChange});
    }
    if (!work.cut)
      work.cut = findAction(context.tree, block, context.dialect,
                            {CodeAction::Linear, CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise});
    if (findCode(context.tree, block, context.dialect, CodeRole::Return))
      break;
  }
  return work.cut && work.change ? std::optional(work) : std::nullopt;
}

std::optional<Work> workOf(const Call &call, const FileContext &context) {
  const Program &caller = context.model.programs[call.caller];
  if (call.kind == CallKind::Local) {
    const Word *number = findWord(context.tree, call.block, 'P');
    const auto sequence = number && number->isNumber() ? number->integer() : std::nullopt;
    const auto target = sequence ? findSequence(context.model, call.caller, *sequence, call.block) : std::nullopt;
    return target ? workOf(*target, caller.last, context) : std::nullopt;
  }
  if (call.kind != CallKind::Subprogram || call.callee.empty())
    return std::nullopt;
  const auto its = std::ranges::find(context.model.programs, call.callee, &Program::name);
  return its == context.model.programs.end() ? std::nullopt : workOf((*its).first, (*its).last, context);
}

bool isSame(const Call &a, const Call &b, const FileContext &context) {
  const Word *first = findWord(context.tree, a.block, 'P');
  const Word *second = findWord(context.tree, b.block, 'P');
  return a.kind == b.kind && first && second && first->isNumber() && second->isNumber() &&
         first->number() == second->number();
}

/// Nothing between the two calls changes the tool, or may do so.
bool keepsTool(BlockId first, BlockId second, const FileContext &context) {
  for (BlockId block = first.next(); block < second; block = block.next())
    if (changesTool(block, context) || !context.tree.statementsOf(block).empty() ||
        !context.model.callsIn(block, block.next()).empty())
      return false;
  return true;
}

void report(const Call &first, const Call &second, const Work &work, const FileContext &context,
            const Reporter &reporter) {
  reporter.report({.message = fmt::format("{} cuts with the tool that the call before it has left in the spindle",
                                          context.quoted(context.tree.blocks[second.block].span())),
                   .span = context.tree.blocks[second.block].span(),
                   .labels = {{context.tree.blocks[first.block].span(), "called before, with the first tool"},
                              {work.cut->span(), "the first cut of the subprogram"},
                              {work.change->span(), "and its last tool change"}},
                   .notes = {"the first cut of the second call is made by the last tool of the subprogram",
                             "change to the first tool at the head of the subprogram"}});
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Milling)
    return;
  const auto calls = context.model.callsOf(program);
  for (std::size_t i = 1; i < calls.size(); ++i)
    if (isSame(calls[i - 1], calls[i], context) && keepsTool(calls[i - 1].block, calls[i].block, context))
      if (const auto work = workOf(calls[i], context))
        report(calls[i - 1], calls[i], *work, context, reporter);
}

} // namespace

extern const Rule secondCallWithLastTool;
const Rule secondCallWithLastTool{
    .info = {"second-call-with-last-tool", Category::Motion, Severity::Warning,
             "Reports a second call of a subprogram that cuts with the tool of its caller, and has changed it."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::second_call_with_last_tool
