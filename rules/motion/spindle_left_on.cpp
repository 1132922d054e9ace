// spindle-left-on: `M99` with the spindle running, and the other returns of the program stop it.
#include "rules/flow/flow_view.h"
#include "rules/flow/loop_view.h"
#include "rules/motion/motion_view.h"

#include <algorithm>

namespace feedhold::rules::spindle_left_on {
namespace {

bool isStopped(const ExitFact &exit) { return exit.state.spindle.isOnly(0); }

/// By the program, in all runs that come there, if a loop runs at least once.
bool isRunning(const ExitFact &exit) {
  const CodeSet &spindle = exit.state.spindle;
  return !spindle.contains(0) && spindle.codes() != 0;
}
bool isSurelyRunning(const ExitFact &exit) { return isRunning(exit) && !exit.state.spindle.mayBeAtEntry(); }

struct Leaving {
  const Word *start;
  std::vector<NodeId> path;
};

/// The last start in the text from which the return is reached.
std::optional<Leaving> leavingTo(const ExitFact &exit, const MotionView &view, const FlowFacts &facts) {
  const auto startAt = [&](NodeId node) {
    return view.findAction(node, {CodeAction::SpindleClockwise, CodeAction::SpindleCounterclockwise});
  };
  const auto blocked = [&](NodeId node) { return startAt(node) || view.findAction(node, {CodeAction::SpindleStop}); };
  for (NodeId node = facts.end(); node > facts.entry();) {
    node = NodeId(node.index() - 1);
    const Word *start = facts.isReached(node) ? startAt(node) : nullptr;
    if (!start)
      continue;
    if (auto path = findPath(facts, node, exit.node, blocked))
      return Leaving{start, std::move(*path)};
  }
  return std::nullopt;
}

/// `S#100 M03`, `G04 P#103` again and again: the spindle is warmed up.
bool warmsUp(const Leaving &leaving, const MotionView &view, const FlowFacts &facts) {
  const NodeId start = leaving.path.front();
  return std::ranges::any_of(loopsOf(facts), [&](const LoopFlow &loop) {
    const auto isIn = [&](NodeId node) { return std::ranges::find(loop.nodes, node) != loop.nodes.end(); };
    return isIn(start) && std::ranges::any_of(loop.nodes, [&](NodeId node) {
             return view.findAction(node, {CodeAction::Dwell}) != nullptr;
           });
  });
}

/// The tool moves between the start and the return: the program is not there to start the spindle.
bool works(const Leaving &leaving, const MotionView &view) {
  return std::ranges::any_of(leaving.path, [&](NodeId node) { return !view.axisWords(node).empty(); });
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts))
    return;
  std::vector<const ExitFact *> running;
  std::vector<const ExitFact *> stopped;
  for (const ExitFact &exit : facts.exits()) {
    if (exit.end != PathEnd::Returns || isOfLocalCall(exit, facts))
      continue;
    if (isStopped(exit))
      stopped.push_back(&exit);
    else if (isRunning(exit))
      running.push_back(&exit);
  }
  constexpr std::size_t kHabit = 2;
  const auto surely = std::ranges::count_if(running, [](const ExitFact *exit) { return isSurelyRunning(*exit); });
  if (stopped.size() < kHabit || static_cast<std::size_t>(surely) >= stopped.size())
    return;
  const MotionView view(facts.program, context);
  for (const ExitFact *exit : running)
    if (const auto leaving = leavingTo(*exit, view, facts);
        leaving && ((isSurelyRunning(*exit) && works(*leaving, view)) || warmsUp(*leaving, view, facts)))
      reporter.report({.message = "the spindle is still on at this return: the other returns of the program stop it",
                       .span = view.blockSpan(exit->node),
                       .labels = {{leaving->start->span(), "started here"},
                                  {view.blockSpan(stopped.front()->node), "returns with the spindle stopped"}},
                       .flow = describePath(facts, leaving->path),
                       .notes = {"the caller goes on, or the operator reaches in, with the spindle running",
                                 "write M05 before this return as well"}});
}

} // namespace

extern const Rule spindleLeftOn;
const Rule spindleLeftOn{.info = {"spindle-left-on", Category::Motion, Severity::Warning,
                                  "Reports a return with the spindle running, when the other returns of the program "
                                  "stop it."},
                         .hooks = {.flow = check}};

} // namespace feedhold::rules::spindle_left_on
