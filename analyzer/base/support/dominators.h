// Dominators of a directed graph: the nodes that every path from node 0 to a node passes (Cooper, Harvey, Kennedy, "A
// simple, fast dominance algorithm", 2001; close to linear on graphs of programs).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace feedhold {

class Dominators {
public:
  /// `successors[n]`: of node n.  At least node 0; iterative, so that a long graph does not overflow the stack.
  explicit Dominators(const std::vector<std::vector<std::uint32_t>> &successors);

  /// From node 0, each behind its immediate dominator.
  const std::vector<std::uint32_t> &reached() const { return nodes_; }
  bool isReached(std::uint32_t node) const { return orders_[node] != kUnreached; }
  /// The nearest node other than this one that every path to it passes; absent for node 0 and those not reached.
  std::optional<std::uint32_t> immediate(std::uint32_t node) const;
  /// Every path from node 0 to `node` passes `by`; vacuously where none leads there.
  bool isDominated(std::uint32_t node, std::uint32_t by) const;

private:
  static constexpr std::uint32_t kUnreached = 0xffffffff;

  void number(const std::vector<std::vector<std::uint32_t>> &successors);
  std::uint32_t nearestCommon(std::uint32_t left, std::uint32_t right) const;

  std::vector<std::uint32_t> nodes_;      // by reverse postorder
  std::vector<std::uint32_t> orders_;     // by node: its place in `nodes_`
  std::vector<std::uint32_t> immediates_; // by place: the place of the immediate dominator
};

} // namespace feedhold
