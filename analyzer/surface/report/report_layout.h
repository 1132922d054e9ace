// A drawing of who calls whom in columns: each program stands to the right of all that call it, unless calls go round
// in a ring.  Internal to sink/.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace feedhold::certificate {

struct LayoutEdge {
  std::size_t from = 0;
  std::size_t to = 0;
};

/// The parts of a graph that hang together: their nodes in order, by the first of them.
std::vector<std::vector<std::size_t>> partsOf(std::size_t nodes, std::span<const LayoutEdge> edges);

struct Layout {
  struct Node {
    std::size_t column = 0;
    double row = 0; // those of one column are at least 1 apart
    bool inCycle = false;
  };
  struct Route {
    bool goesBack = false;      // closes a ring: it leads to the same column or to one before
    std::vector<double> passes; // rows in the columns between the two
  };
  std::vector<Node> nodes;
  std::vector<Route> routes; // of each edge
  std::size_t columns = 0;
  double rows = 0; // the largest row and 1
};

/// Sugiyama, Tagawa, Toda, Methods for visual understanding of hierarchical system structures (1981): columns by the
/// longest path, order within them by barycentres.  The same input gives the same layout.
Layout layoutOf(std::size_t nodes, std::span<const LayoutEdge> edges);

} // namespace feedhold::certificate
