// An immediate dominator is the nearest common one of the predecessors: repeated in reverse postorder until it is
// stable.
#include "base/support/dominators.h"

#include <algorithm>

namespace feedhold {

Dominators::Dominators(const std::vector<std::vector<std::uint32_t>> &successors)
    : orders_(successors.size(), kUnreached) {
  number(successors);
  std::vector<std::vector<std::uint32_t>> predecessors(nodes_.size());
  for (std::uint32_t place = 0; place < nodes_.size(); ++place)
    for (const std::uint32_t next : successors[nodes_[place]])
      predecessors[orders_[next]].push_back(place);
  immediates_.assign(nodes_.size(), kUnreached);
  immediates_.front() = 0;
  for (bool isStable = false; !isStable;) {
    isStable = true;
    for (std::uint32_t place = 1; place < nodes_.size(); ++place) {
      std::uint32_t nearest = kUnreached;
      for (const std::uint32_t before : predecessors[place])
        if (immediates_[before] != kUnreached)
          nearest = nearest == kUnreached ? before : nearestCommon(nearest, before);
      isStable = isStable && immediates_[place] == nearest;
      immediates_[place] = nearest;
    }
  }
}

/// In reverse postorder, from node 0.
void Dominators::number(const std::vector<std::vector<std::uint32_t>> &successors) {
  struct Visit {
    std::uint32_t node;
    std::size_t next = 0;
  };
  std::vector<bool> seen(successors.size());
  seen[0] = true;
  std::vector<Visit> open{{0}};
  while (!open.empty()) {
    Visit &visit = open.back();
    if (visit.next == successors[visit.node].size()) {
      nodes_.push_back(visit.node);
      open.pop_back();
      continue;
    }
    const std::uint32_t next = successors[visit.node][visit.next++];
    if (!seen[next]) {
      seen[next] = true;
      open.push_back({next});
    }
  }
  std::ranges::reverse(nodes_);
  for (std::uint32_t place = 0; place < nodes_.size(); ++place)
    orders_[nodes_[place]] = place;
}

std::uint32_t Dominators::nearestCommon(std::uint32_t left, std::uint32_t right) const {
  while (left != right) {
    std::uint32_t &later = left > right ? left : right;
    later = immediates_[later];
  }
  return left;
}

std::optional<std::uint32_t> Dominators::immediate(std::uint32_t node) const {
  if (!isReached(node) || orders_[node] == 0)
    return std::nullopt;
  return nodes_[immediates_[orders_[node]]];
}

bool Dominators::isDominated(std::uint32_t node, std::uint32_t by) const {
  if (!isReached(node))
    return true;
  if (!isReached(by))
    return false;
  std::uint32_t place = orders_[node];
  while (place > orders_[by])
    place = immediates_[place];
  return place == orders_[by];
}

} // namespace feedhold
