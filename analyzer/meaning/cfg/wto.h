// Wto: a weak topological order of a graph (Bourdoncle, "Efficient chaotic iteration strategies with widenings", 1993):
// every cycle has a head, and every edge that leads backwards in the order ends at one.
#pragma once

#include "meaning/cfg/cfg.h"

#include <optional>
#include <vector>

namespace feedhold {

class Wto {
public:
  /// Of the nodes that can be reached from `entry`, calls taken as going on to their return.  Iterative: a program of a
  /// million blocks does not overflow the stack.
  Wto(const Cfg &cfg, const ProgramModel &model, NodeId entry, ProgramUse use = ProgramUse::Called);

  static constexpr std::uint32_t kUnreachable = 0xffffffff;
  /// The reachable nodes, in order.
  const std::vector<NodeId> &order() const { return order_; }
  /// kUnreachable for those that are not.
  std::uint32_t positionOf(NodeId node) const;
  bool isHead(NodeId node) const;
  /// The head of the innermost component that holds the node; the node itself when it is a head or in none.
  NodeId headOf(NodeId node) const;
  /// The head of the innermost component that holds the node and begins before it.
  std::optional<NodeId> headAround(NodeId node) const;
  /// How many components hold the node.
  std::uint32_t depthOf(NodeId node) const;
  /// The position behind the last node of the component that the head begins.
  std::uint32_t endOf(NodeId head) const;

private:
  enum class Head : std::uint8_t { No, Yes };
  bool hasLoops() const { return !isHead_.empty(); }
  void reserveForLoops(std::size_t size);
  void append(NodeId node);
  void appendInLoops(NodeId node, std::optional<NodeId> around, Head head);

  std::vector<NodeId> order_;
  NodeId first_;                         // entry of the program; positions_ starts with it
  std::vector<std::uint32_t> positions_; // by node
  // Empty in a program without loops:
  std::vector<std::uint32_t> arounds_; // by position: the position of the head around it
  std::vector<std::uint32_t> ends_;    // by position of a head: behind its component; of others behind themselves
  std::vector<bool> isHead_;           // by position
  std::vector<std::uint32_t> depths_;  // by position
};

} // namespace feedhold
