// See the header.
#include "rules/motion/left_on.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules {
namespace {

/// A code that puts the mode on, with the end that is reached from it.
struct Leaving {
  const Word *word;
  NodeId exit;
  std::vector<NodeId> way;
};

std::vector<NodeId> switchingNodes(const LeftOn &mode, const MotionView &view, const FlowFacts &facts) {
  std::vector<NodeId> nodes;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    if (facts.isReached(node) && view.findAction(node, mode.actions))
      nodes.push_back(node);
  return nodes;
}

std::optional<Leaving> leavingFrom(NodeId from, const ExitFact &exit, const LeftOn &mode, const MotionView &view,
                                   const FlowFacts &facts) {
  const auto sets = [&](NodeId node) {
    return view.sets(node, mode.kind) || (mode.kind == ModalKind::Cycle && view.sets(node, ModalKind::Motion));
  };
  auto way = findWay(facts, from, exit.node, sets);
  if (!way)
    return std::nullopt;
  return Leaving{view.findAction(from, mode.actions), exit.node, std::move(*way)};
}

bool leaves(const ExitFact &exit, const LeftOn &mode, const MotionView &view) {
  if (exit.end == PathEnd::Alarm || (exit.end == PathEnd::Ends && !mode.atProgramEnd))
    return false;
  return view.wasSet(exit.state, mode.kind, mode.actions);
}

void tell(const Leaving &leaving, const ExitFact &exit, const LeftOn &mode, const MotionView &view,
          const FlowFacts &facts, const Reporter &reporter) {
  const bool returns = exit.end == PathEnd::Returns;
  reporter.report({.message = fmt::format("{} is still in force when the program {}",
                                          view.context().quoted(leaving.word->span()), returns ? "returns" : "ends"),
                   .span = leaving.word->span(),
                   .labels = {{view.blockSpan(leaving.exit), returns ? "returns here" : "ends here"}},
                   .way = describeWay(facts, leaving.way),
                   .notes = {std::string(mode.consequence), std::string(mode.remedy)}},
                  returns ? Severity::Warning : mode.atProgramEnd.value_or(Severity::Warning));
}

} // namespace

void reportLeftOn(const LeftOn &mode, const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  const MotionView view(facts.program, context);
  const std::vector<NodeId> switching = switchingNodes(mode, view, facts);
  std::vector<const Word *> told;
  for (const ExitFact &exit : facts.exits()) {
    if (!leaves(exit, mode, view))
      continue;
    std::optional<Leaving> leaving;
    for (auto node = switching.rbegin(); node != switching.rend() && !leaving; ++node)
      leaving = leavingFrom(*node, exit, mode, view, facts);
    if (!leaving || std::ranges::find(told, leaving->word) != told.end())
      continue;
    told.push_back(leaving->word);
    tell(*leaving, exit, mode, view, facts, reporter);
  }
}

} // namespace feedhold::rules
