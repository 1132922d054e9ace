#include "findings/rule/flow_way.h"

#include <algorithm>
#include <deque>

namespace feedhold {

namespace {

constexpr std::size_t kMostSteps = 8; // of a way that a person still reads

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

/// What is decided at a node when the way goes on to `next`; empty for nothing.
std::string decision(const FlowFacts &facts, NodeId node, NodeId next) {
  const Node &here = facts.node(node);
  if (const auto *test = std::get_if<Test>(&here.instruction)) {
    if (facts.truthOf(node).value_or(Truth::Maybe) != Truth::Maybe)
      return {};
    return next == test->taken ? "the condition holds" : "the condition does not hold";
  }
  if (const auto *skip = std::get_if<BlockSkip>(&here.instruction))
    return next == skip->skipped ? "the block is skipped" : "";
  if (const auto *count = std::get_if<CountDown>(&here.instruction))
    return next == count->taken ? "another pass" : "no pass is left";
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

} // namespace

std::optional<std::vector<NodeId>> findWay(const FlowFacts &facts, NodeId from, NodeId to,
                                           const std::function<bool(NodeId)> &blocked) {
  const std::size_t first = facts.entry().index();
  std::vector<std::uint32_t> before(facts.end().index() - first, 0xffffffff);
  std::deque<NodeId> open{from};
  const auto visit = [&](NodeId node, NodeId next) {
    if (next.index() < first || next.index() - first >= before.size() || before[next.index() - first] != 0xffffffff ||
        !facts.isReached(next) || (next != to && blocked(next)) || isExcluded(facts, node, next))
      return;
    before[next.index() - first] = node.index();
    open.push_back(next);
  };
  bool found = false;
  while (!open.empty() && !found) {
    const NodeId node = open.front();
    open.pop_front();
    forEachSuccessor(facts.file.cfg, *facts.file.model, node, ProgramUse::Called,
                     [&](NodeId next) { visit(node, next); });
    found = before[to.index() - first] != 0xffffffff;
  }
  if (!found)
    return std::nullopt;
  std::vector<NodeId> way{to};
  for (NodeId node = to; way.size() <= before.size();) {
    node = NodeId(before[node.index() - first]);
    way.push_back(node);
    if (node == from)
      break;
  }
  std::reverse(way.begin(), way.end());
  return way;
}

std::vector<Label> describeWay(const FlowFacts &facts, std::span<const NodeId> way) {
  std::vector<Label> labels;
  for (std::size_t i = 0; i + 1 < way.size(); ++i)
    if (std::string text = decision(facts, way[i], way[i + 1]); !text.empty())
      labels.push_back(labelOf(facts, way[i], std::move(text)));
  if (labels.size() > kMostSteps) // the last decisions tell most
    labels.erase(labels.begin(), labels.end() - kMostSteps);
  return labels;
}

std::vector<Label> wayFromEntry(const FlowFacts &facts, NodeId to, const std::function<bool(NodeId)> &blocked) {
  const auto way = findWay(facts, facts.entry(), to, blocked);
  return way ? describeWay(facts, *way) : std::vector<Label>{};
}

std::optional<NodeId> reachedNode(const FlowFacts &facts, BlockId block) {
  for (NodeId node = facts.file.cfg.nodeOf(block); node < facts.end() && facts.node(node).block == block;
       node = node.next())
    if (facts.isReached(node))
      return node;
  return std::nullopt;
}

} // namespace feedhold
