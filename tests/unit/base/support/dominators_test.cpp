#include "base/support/dominators.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

namespace feedhold {
namespace {

using Graph = std::vector<std::vector<std::uint32_t>>;

/// From node 0, not through `without`.
std::vector<bool> reachedIn(const Graph &graph, std::optional<std::uint32_t> without) {
  std::vector<bool> reached(graph.size());
  std::vector<std::uint32_t> open;
  const auto visit = [&](std::uint32_t node) {
    if (node != without && !reached[node]) {
      reached[node] = true;
      open.push_back(node);
    }
  };
  visit(0);
  while (!open.empty()) {
    const std::uint32_t node = open.back();
    open.pop_back();
    std::ranges::for_each(graph[node], visit);
  }
  return reached;
}

Graph anyGraph() {
  const auto size = *rc::gen::inRange<std::uint32_t>(1, 12);
  Graph graph(size);
  for (auto &successors : graph)
    successors =
        *rc::gen::resize(3, rc::gen::container<std::vector<std::uint32_t>>(rc::gen::inRange<std::uint32_t>(0, size)));
  return graph;
}

TEST(Dominators, AreWhatNoPathGoesRound) {
  EXPECT_TRUE(rc::check([] {
    const Graph graph = anyGraph();
    const Dominators dominators(graph);
    const std::vector<bool> reached = reachedIn(graph, std::nullopt);
    for (std::uint32_t by = 0; by < graph.size(); ++by) {
      const std::vector<bool> round = reachedIn(graph, by);
      for (std::uint32_t node = 0; node < graph.size(); ++node) {
        RC_ASSERT(dominators.isReached(node) == reached[node]);
        RC_ASSERT(dominators.isDominated(node, by) == !round[node]);
      }
    }
  }));
}

TEST(Dominators, ImmediateIsTheNearest) {
  EXPECT_TRUE(rc::check([] {
    const Graph graph = anyGraph();
    const Dominators dominators(graph);
    for (std::uint32_t node = 0; node < graph.size(); ++node) {
      const auto immediate = dominators.immediate(node);
      RC_ASSERT(immediate.has_value() == (node != 0 && dominators.isReached(node)));
      for (std::uint32_t by = 0; immediate && by < graph.size(); ++by)
        if (by != node && dominators.isDominated(node, by))
          RC_ASSERT(dominators.isDominated(*immediate, by));
    }
  }));
}

} // namespace
} // namespace feedhold
