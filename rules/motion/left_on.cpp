// See the header.
#include "rules/motion/left_on.h"

#include "rules/motion/behind_calls.h"
#include "rules/motion/folder_programs.h"
#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace feedhold::rules {
namespace {

/// A code that puts the mode on, with the end that is reached from it.
struct Leaving {
  const Word *word;
  NodeId exit;
  std::vector<NodeId> path;
};

std::vector<NodeId> switchingNodes(const LeftOn &mode, const MotionView &view, const FlowFacts &facts) {
  std::vector<NodeId> nodes;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    if (facts.isReached(node) && switchedBy(mode, view, node))
      nodes.push_back(node);
  return nodes;
}

/// A call, which may be of a program that is not among the files, a code that the dialect does not have, or a block
/// that could not be read.
bool mayPutRightUnseen(const MotionView &view, NodeId node) {
  const Instruction &instruction = view.node(node).instruction;
  const BlockId block = view.node(node).block;
  const bool isBroken = view.context().tree.blocks[block].has(Block::kBroken);
  if (std::holds_alternative<Havoc>(instruction) && isBroken && !mayHoldCode(view.context(), block, "GMOT"))
    return false;
  if (std::holds_alternative<CallProgram>(instruction) || std::holds_alternative<Havoc>(instruction))
    return true;
  return std::ranges::any_of(
      view.wordsOf(node), [&](const Word *word) { return word->isCode() && !codeOf(*word, view.context().dialect); });
}

/// The switches with which the block of the node is skipped: `/`, `/2`.
std::set<std::uint8_t> skipSwitchesOf(const MotionView &view, NodeId node) {
  std::set<std::uint8_t> levels;
  for (NodeId before = node; before.index() > 0;) {
    before = NodeId(before.index() - 1);
    if (view.node(before).block != view.node(node).block)
      break;
    if (const auto *skip = std::get_if<BlockSkip>(&view.node(before).instruction))
      levels.insert(skip->level);
  }
  return levels;
}

/// `/G40`: the block takes the mode away, and is skipped by a switch with which the block that put it on is skipped,
/// too.
bool isSkippedTogether(NodeId node, const std::set<std::uint8_t> &switches, const LeftOn &mode,
                       const MotionView &view) {
  const auto *skip = std::get_if<BlockSkip>(&view.node(node).instruction);
  if (!skip || !switches.contains(skip->level))
    return false;
  for (NodeId in = node.next(); in < skip->skipped && view.node(in).block == view.node(node).block; in = in.next())
    if (decides(mode, view, in))
      return true;
  return false;
}

std::optional<Leaving> leavingFrom(NodeId from, const ExitFact &exit, const LeftOn &mode, const MotionView &view,
                                   const FlowFacts &facts) {
  const std::set<std::uint8_t> switches = skipSwitchesOf(view, from);
  const auto sets = [&](NodeId node) {
    return decides(mode, view, node) || isSkippedTogether(node, switches, mode, view) ||
           (mode.kind == ModalKind::Cycle && view.sets(node, ModalKind::Motion)) ||
           (isHavocked(exit.state) && mayPutRightUnseen(view, node));
  };
  auto path = findPath(facts, from, exit.node, sets);
  if (!path)
    return std::nullopt;
  return Leaving{switchedBy(mode, view, from), exit.node, std::move(*path)};
}

/// The contract of the program says that its caller has the mode on.
bool isOnAtEntry(const LeftOn &mode, const MotionView &view, const FlowFacts &facts) {
  const auto group = mode.special ? std::nullopt : view.modes().groupOf(mode.kind);
  if (!group || facts.entryCodes()[*group].mayBeAtEntry())
    return false;
  return (facts.entryCodes()[*group].codes() & ~view.modes().maskOf(mode.kind, mode.actions)) == 0;
}

bool leaves(const ExitFact &exit, const LeftOn &mode, const MotionView &view) {
  const bool isRestored = exit.end == PathEnd::Ends && view.context().dialect.behaviour.endRestoresModes;
  if (exit.end == PathEnd::Alarm || isRestored || (exit.end == PathEnd::Ends && !mode.atProgramEnd))
    return false;
  if (mode.special)
    return mode.special->isOn(exit.state);
  return isHavocked(exit.state) || view.wasSet(exit.state, mode.kind, mode.actions);
}

/// M73: the modes that the caller had are in force again at the return.  Not so the motion code, nor origins.
bool isRestoredAtReturn(const LeftOn &mode, const MotionView &view, const FlowFacts &facts) {
  if (mode.special || mode.kind == ModalKind::Cycle)
    return false;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    if (facts.isReached(node) && view.findAction(node, {CodeAction::ModesSaveForReturn}) != nullptr)
      return true;
  return false;
}

bool cancels(const LeftOn &mode, const FileContext &context) {
  if (context.model.programs.empty())
    return false;
  const MotionView view(ProgramId(0), context);
  for (NodeId node(0); node.index() < view.cfg().nodes.size(); node = node.next())
    if (decides(mode, view, node) && !switchedBy(mode, view, node))
      return true;
  return false;
}

bool isCancelledElsewhere(const LeftOn &mode, const FileContext &context) {
  return std::ranges::any_of(filesOfFolder(context), [&](FileId file) {
    return cancels(mode, contextOf(context.programs->file(file), context));
  });
}

/// A text without a number that stops without M30: what comes behind it is not known.
bool isOfFragment(const ExitFact &exit, const MotionView &view) {
  const FileContext &context = view.context();
  return exit.end == PathEnd::Ends && !isNamed(context.model.programs[view.program()]) &&
         !findCode(context.tree, view.node(exit.node).block, context.dialect, CodeRole::ProgramEnd) &&
         !context.dialect.grammar.oWords;
}

/// How much it matters; absent: it is as it should be.
std::optional<Severity> severityAt(const ExitFact &exit, const LeftOn &mode, const CallersOfMode &callers) {
  if (exit.end == PathEnd::Ends)
    return mode.atProgramEnd.value_or(Severity::Warning);
  if (mode.special) // to shift the caller is what such a program is for
    return callers.allInFile ? std::nullopt : std::optional(Severity::Info);
  if (callers.behind == BehindCalls::MovesOn)
    return Severity::Warning;
  if (!callers.allInFile)
    return Severity::Info;
  return callers.behind == BehindCalls::LeftAtEnd ? mode.atProgramEnd : std::nullopt;
}

void tell(const Leaving &leaving, const ExitFact &exit, Severity severity, const LeftOn &mode, const MotionView &view,
          const FlowFacts &facts, const Reporter &reporter) {
  const bool returns = exit.end == PathEnd::Returns;
  reporter.report({.message = fmt::format("{} is still active when the program {}",
                                          view.context().quoted(leaving.word->span()), returns ? "returns" : "ends"),
                   .span = leaving.word->span(),
                   .labels = {{view.blockSpan(leaving.exit), returns ? "returns here" : "ends here"}},
                   .flow = describePath(facts, leaving.path),
                   .notes = {std::string(mode.consequence), std::string(mode.remedy)}},
                  severity);
}

} // namespace

const Word *switchedBy(const LeftOn &mode, const MotionView &view, NodeId node) {
  return mode.special ? mode.special->switchedBy(view, node) : view.findAction(node, mode.actions);
}

bool decides(const LeftOn &mode, const MotionView &view, NodeId node) {
  return mode.special ? mode.special->putsRight(view, node) : view.sets(node, mode.kind);
}

void reportLeftOn(const LeftOn &mode, const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  const MotionView view(facts.program, context);
  if (isOnAtEntry(mode, view, facts))
    return;
  if (std::ranges::none_of(facts.exits(), [&](const ExitFact &exit) { return leaves(exit, mode, view); }))
    return;
  const std::vector<NodeId> switching = switchingNodes(mode, view, facts);
  if (switching.empty())
    return; // before the whole folder is looked through
  const CallersOfMode callers = behindCalls(mode, facts, context);
  const bool isRestored = isRestoredAtReturn(mode, view, facts);
  const bool isForgotten = mode.followsHabit && isCancelledElsewhere(mode, context);
  std::vector<const Word *> told;
  for (const ExitFact &exit : facts.exits()) {
    if (isOfFragment(exit, view))
      continue;
    const auto severity = leaves(exit, mode, view) ? severityAt(exit, mode, callers) : std::nullopt;
    const bool isKept = callers.behindLocal == BehindCalls::PutRight && isOfLocalCall(exit, facts);
    if (!severity || isKept || (isRestored && exit.end == PathEnd::Returns))
      continue;
    std::optional<Leaving> leaving;
    for (auto node = switching.rbegin(); node != switching.rend() && !leaving; ++node)
      leaving = leavingFrom(*node, exit, mode, view, facts);
    if (!leaving || std::ranges::find(told, leaving->word) != told.end())
      continue;
    told.push_back(leaving->word);
    const bool warns = isForgotten && exit.end == PathEnd::Ends;
    tell(*leaving, exit, warns ? Severity::Warning : *severity, mode, view, facts, reporter);
  }
}

} // namespace feedhold::rules
