#include "findings/rule/flow_path.h"

#include <algorithm>
#include <deque>

namespace feedhold {

namespace {

constexpr std::size_t kMostSteps = 8; // of a path that a person still reads

Label labelOf(const FlowFacts &facts, NodeId node, std::string text) {
  return {facts.file.tree->blocks[facts.node(node).block].span(), std::move(text), std::nullopt};
}

/// `N10` for the label at which a jump arrives.
std::string labelName(const FlowFacts &facts, NodeId from, NodeId next) {
  const BlockId jump = facts.node(from).block;
  for (const SequenceNumber &number : facts.file.model->sequenceNumbersOf(facts.program))
    if (arrival(facts.file.cfg, number.block, jump) == next)
      return "N" + std::to_string(number.number);
  return "a sequence number";
}

/// What is decided at a node when the path goes on to `next`; empty for nothing.
std::string decision(const FlowFacts &facts, NodeId node, NodeId next) {
  const Node &here = facts.node(node);
  if (const auto *test = std::get_if<Test>(&here.instruction)) {
    if (facts.truthOf(node).value_or(Truth::Maybe) != Truth::Maybe)
      return {};
    return next == test->taken ? "the condition is true" : "the condition is false";
  }
  if (const auto *skip = std::get_if<BlockSkip>(&here.instruction))
    return next == skip->skipped ? "the block is skipped" : "";
  if (const auto *count = std::get_if<CountDown>(&here.instruction))
    return next == count->taken ? "repeats once more" : "no repetition is left";
  if (std::holds_alternative<JumpTo>(here.instruction))
    return "jumps to " + labelName(facts, node, next);
  return {};
}

/// No run goes on from a condition to the side on which it never comes out.
bool isExcluded(const FlowFacts &facts, NodeId node, NodeId next) {
  const auto *test = std::get_if<Test>(&facts.node(node).instruction);
  if (!test || test->taken == facts.node(node).next)
    return false;
  const Truth truth = facts.truthOf(node).value_or(Truth::Maybe);
  return (truth == Truth::True && next != test->taken) || (truth == Truth::False && next == test->taken);
}

/// Breadth first over what is reached, from behind a node on, not over what is blocked.
class PathSearch {
public:
  PathSearch(const FlowFacts &facts, NodeId from) : facts_(facts), trail_(facts.trail()), from_(from), open_{from} {
    trail_.start(facts.end().index() - facts.entry().index());
  }

  /// Enters what mayEnter(node) lets it enter, until it has come to `to`; false: it does not, or has no aim.
  template <typename MayEnter> bool run(std::optional<NodeId> to, MayEnter &&mayEnter) {
    while (!open_.empty()) {
      const NodeId node = open_.front();
      open_.pop_front();
      forEachSuccessor(facts_.file.cfg, *facts_.file.model, node, ProgramUse::Called, [&](NodeId next) {
        if (isNew(node, next) && mayEnter(next)) {
          trail_.put(slotOf(next), node.index());
          open_.push_back(next);
        }
      });
      if (to && trail_.isKnown(slotOf(*to)))
        return true;
    }
    return false;
  }
  bool hasReached(NodeId node) const { return trail_.isKnown(slotOf(node)); }
  std::vector<NodeId> pathTo(NodeId to) const {
    std::vector<NodeId> path{to};
    do
      path.push_back(NodeId(trail_.before(slotOf(path.back()))));
    while (path.back() != from_);
    std::reverse(path.begin(), path.end());
    return path;
  }

private:
  std::size_t slotOf(NodeId node) const { return node.index() - facts_.entry().index(); }
  bool isNew(NodeId node, NodeId next) const {
    return next >= facts_.entry() && next < facts_.end() && !hasReached(next) && facts_.isReached(next) &&
           !isExcluded(facts_, node, next);
  }

  const FlowFacts &facts_;
  SearchTrail &trail_;
  NodeId from_;
  std::deque<NodeId> open_;
};

} // namespace

std::optional<std::vector<NodeId>> findPath(const FlowFacts &facts, NodeId from, NodeId to,
                                            const std::function<bool(NodeId)> &blocked) {
  PathSearch search(facts, from);
  if (!search.run(to, [&](NodeId next) { return next == to || !blocked(next); }))
    return std::nullopt;
  return search.pathTo(to);
}

std::optional<NodeId> firstReached(const FlowFacts &facts, NodeId from, std::span<const NodeId> wanted,
                                   const std::function<bool(NodeId)> &blocked) {
  PathSearch search(facts, from);
  search.run(std::nullopt, [&](NodeId next) { return !blocked(next); });
  const auto found = std::find_if(wanted.begin(), wanted.end(), [&](NodeId node) { return search.hasReached(node); });
  return found == wanted.end() ? std::nullopt : std::optional(*found);
}

namespace {

/// `tells`: of the index of a node in the path, before the last one.
template <typename Tells>
std::vector<Label> decisionsOf(const FlowFacts &facts, std::span<const NodeId> path, Tells tells) {
  std::vector<Label> labels;
  for (std::size_t i = 0; i + 1 < path.size(); ++i)
    if (std::string text = decision(facts, path[i], path[i + 1]); !text.empty() && tells(i))
      labels.push_back(labelOf(facts, path[i], std::move(text)));
  if (labels.size() > kMostSteps) // the last decisions tell most
    labels.erase(labels.begin(), labels.end() - kMostSteps);
  return labels;
}

} // namespace

std::vector<Label> describePath(const FlowFacts &facts, std::span<const NodeId> path) {
  return decisionsOf(facts, path, [](std::size_t) { return true; });
}

std::vector<Label> describePathPast(const FlowFacts &facts, std::span<const NodeId> path,
                                    const std::function<bool(NodeId)> &isPassed) {
  std::vector<Label> labels = decisionsOf(facts, path, [&](std::size_t i) {
    for (NodeId node = path[i].next(); node < path[i + 1]; node = node.next())
      if (isPassed(node))
        return true;
    return false;
  });
  return labels.empty() ? describePath(facts, path) : labels;
}

std::vector<Label> pathFromEntry(const FlowFacts &facts, NodeId to, const std::function<bool(NodeId)> &blocked) {
  const auto path = findPath(facts, facts.entry(), to, blocked);
  return path ? describePath(facts, *path) : std::vector<Label>{};
}

std::optional<NodeId> reachedNode(const FlowFacts &facts, BlockId block) {
  for (NodeId node = facts.file.cfg.nodeOf(block); node < facts.end() && facts.node(node).block == block;
       node = node.next())
    if (facts.isReached(node))
      return node;
  return std::nullopt;
}

} // namespace feedhold
