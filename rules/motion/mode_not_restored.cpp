// mode-not-restored: `#3=#4003 .. G#3`, and a path to the end that passes over the G#3; `M70` without `M72`.
#include "rules/flow/seen_locals.h"
#include "rules/motion/saved_mode.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::mode_not_restored {
namespace {

/// The last code in the text that changes the mode and from which the end is reached without restoring it.
std::optional<std::pair<NodeId, std::vector<NodeId>>> changeBefore(const ExitFact &exit, const Saving &saving,
                                                                   const MotionView &view, const FlowFacts &facts) {
  for (NodeId node = facts.end(); node != facts.entry();) {
    node = NodeId(node.index() - 1);
    if (!facts.isReached(node) || !setsGroup(view, node, saving.group))
      continue;
    if (auto path =
            findPath(facts, node, exit.node, [&](NodeId other) { return restores(view, other, saving.variable); }))
      return std::pair{node, std::move(*path)};
  }
  return std::nullopt;
}

/// M70, in a program that has no M72.
const Word *saveWithoutRestore(const FlowFacts &facts, const FileContext &context) {
  const Word *save = nullptr;
  const Program &program = context.model.programs[facts.program];
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    if (findAction(context.tree, block, context.dialect, {CodeAction::ModesRestore, CodeAction::ModesSaveForReturn}))
      return nullptr;
    const Word *own = findAction(context.tree, block, context.dialect, {CodeAction::ModesSave});
    save = save ? save : own;
  }
  return save;
}

/// Returns in other modes than those of the call; which move was made last does not count.
bool changesModes(const ExitFact &exit, const FlowFacts &facts) {
  const auto motion = facts.modes.groupOf(ModalKind::Motion);
  if (exit.end != PathEnd::Returns || isHavocked(exit.state) || isOfLocalCall(exit, facts))
    return false;
  for (std::size_t group = 1; group < kModalGroups; ++group)
    if (group != motion && !leq(exit.state.codes[group], facts.entryCodes()[group]))
      return true;
  return false;
}

void checkSave(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  const Word *save = saveWithoutRestore(facts, context);
  if (!save || !std::ranges::any_of(facts.exits(), [&](const ExitFact &exit) { return changesModes(exit, facts); }))
    return;
  reporter.report(
      {.message = fmt::format("{} saves the modes, and nothing restores them", context.quoted(save->span())),
       .span = save->span(),
       .notes = {"the caller continues in other modes than before the call",
                 "write `M72` before each end of the subroutine, or `M73` in place of this code"}});
}

/// `#2=#4003`, alone in its statement: which variable, and which group.  Of the move that was made last a caller does
/// not ask.
std::optional<Saving> savingIn(const Statement &statement, const FlowFacts &facts, const FileContext &context) {
  const auto *assignment = std::get_if<Assignment>(&statement.node);
  const auto group = assignment && !statement.nested ? groupReadBy(assignment->value, context) : std::nullopt;
  const auto variable = group ? variableNumber(context.tree, assignment->target) : std::nullopt;
  if (!variable || !isLocal(facts.file, *variable) || group == facts.modes.groupOf(ModalKind::Motion))
    return std::nullopt;
  return Saving{*group, *variable, context.tree.blockAt(statement.span.begin), statement.span};
}

bool isReadHere(std::uint32_t variable, const FlowFacts &facts) {
  return std::ranges::any_of(readsOf(facts), [&](const Read &read) { return read.number == variable; });
}

/// The last code of the group from which the end is reached: the mode that is left.  What is called behind it has local
/// variables of its own, and cannot know the mode that was saved.
std::optional<NodeId> changeLeftAt(const ExitFact &exit, std::uint8_t group, const MotionView &view,
                                   const FlowFacts &facts) {
  for (NodeId node = facts.end(); node != facts.entry();) {
    node = NodeId(node.index() - 1);
    const auto isOther = [&](NodeId other) { return other != node && setsGroup(view, other, group); };
    if (facts.isReached(node) && setsGroup(view, node, group) && findPath(facts, node, exit.node, isOther))
      return view.findAction(node, {CodeAction::Absolute}) ? std::nullopt : std::optional(node);
  }
  return std::nullopt;
}

/// A mode that is saved and changed, and of which nothing reads what was saved.
void checkUnread(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  const MotionView view(facts.program, context);
  const Program &program = context.model.programs[facts.program];
  for (BlockId block = program.first; block < program.last; block = block.next())
    for (const Statement &statement : context.tree.statementsOf(block)) {
      const auto saving = savingIn(statement, facts, context);
      if (!saving || isReadHere(saving->variable, facts) || mayHoldCallersValue(facts, saving->variable))
        continue;
      for (const ExitFact &exit : facts.exits()) {
        const auto change =
            exit.end == PathEnd::Returns ? changeLeftAt(exit, saving->group, view, facts) : std::nullopt;
        if (!change || isOfLocalCall(exit, facts))
          continue;
        reporter.report(
            {.message = fmt::format("the mode saved in `#{}` is never restored", saving->variable),
             .span = saving->place,
             .labels = {{view.blockSpan(*change), "changed here"}, {view.blockSpan(exit.node), "returns here"}},
             .notes = {"the caller continues in another mode than before the call",
                       fmt::format("restore it with `G#{}` before the end", saving->variable)}});
        return;
      }
    }
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  checkSave(facts, context, reporter);
  if (seesLocals(facts))
    checkUnread(facts, context, reporter);
  const std::vector<Saving> savings = savingsOf(facts.program, context);
  if (savings.empty())
    return;
  const MotionView view(facts.program, context);
  for (const Saving &saving : savings)
    for (const ExitFact &exit : facts.exits()) {
      if (exit.end != PathEnd::Returns || isHavocked(exit.state) ||
          leq(exit.state.codes[saving.group], facts.entryCodes()[saving.group]) || isOfLocalCall(exit, facts))
        continue;
      const auto change = changeBefore(exit, saving, view, facts);
      if (!change)
        continue;
      reporter.report(
          {.message = fmt::format("the mode saved in `#{}` is not restored on a path to this end", saving.variable),
           .span = view.blockSpan(exit.node),
           .labels = {{saving.place, "saved here"}, {view.blockSpan(change->first), "changed here"}},
           .flow = describePath(facts, change->second),
           .notes = {"the caller continues in another mode than before the call",
                     fmt::format("restore it with `G#{}` before this end, too", saving.variable)}});
    }
}

} // namespace

extern const Rule modeNotRestored;
const Rule modeNotRestored{
    .info =
        {"mode-not-restored", Category::Motion, Severity::Warning,
         "Reports a called program that saves a mode of its caller but, on some path, returns without restoring it."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::mode_not_restored
