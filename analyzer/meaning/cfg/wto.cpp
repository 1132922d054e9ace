// Weak topological order by way of the forest of loops: a depth-first search, then the nodes of each loop found from
// its inner loops outwards, then siblings in reverse postorder.  After Kim, Venet and Thakur, "Deterministic parallel
// fixpoint computation" (2020), who show that this is Bourdoncle's order; unlike his algorithm it is near linear
// however deep the loops lie in one another, and needs no recursion.
#include "meaning/cfg/wto.h"

#include <algorithm>
#include <numeric>

namespace feedhold {

namespace {

constexpr std::uint32_t kNone = 0xffffffff;

/// Sets of numbers that are only ever joined.  The root of a set is the one to which the others were joined.
class DisjointSets {
public:
  explicit DisjointSets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0u); }
  void add() { parent_.push_back(static_cast<std::uint32_t>(parent_.size())); }
  std::uint32_t rootOf(std::uint32_t each) {
    while (parent_[each] != each) {
      parent_[each] = parent_[parent_[each]];
      each = parent_[each];
    }
    return each;
  }
  void join(std::uint32_t each, std::uint32_t root) { parent_[each] = root; }

private:
  std::vector<std::uint32_t> parent_;
};

/// A list for each number, the last that was added first.
template <typename T> class Lists {
public:
  void add(std::uint32_t list, T value) {
    if (first_.size() <= list)
      first_.resize(list + 1, kNone);
    links_.push_back({value, first_[list]});
    first_[list] = static_cast<std::uint32_t>(links_.size() - 1);
  }
  template <typename Visit> void forEach(std::uint32_t list, Visit &&visit) const {
    for (std::uint32_t at = list < first_.size() ? first_[list] : kNone; at != kNone; at = links_[at].next)
      visit(links_[at].value);
  }
  bool isEmpty(std::uint32_t list) const { return list >= first_.size() || first_[list] == kNone; }
  bool isEmpty() const { return links_.empty(); }
  void reserve(std::size_t size) {
    first_.reserve(size);
    links_.reserve(size);
  }

private:
  struct Link {
    T value;
    std::uint32_t next;
  };
  std::vector<std::uint32_t> first_;
  std::vector<Link> links_;
};

struct Edge {
  std::uint32_t from;
  std::uint32_t to;
};

/// What a depth-first search finds.  Nodes are numbered in the order in which it meets them; the entry is 0.
class Search {
public:
  Search(const Cfg &cfg, const ProgramModel &model, ProgramUse use, NodeId first, std::size_t size)
      : cfg_(cfg), model_(model), use_(use), first_(first), numbers_(size, kNone) {
    nodes.reserve(size);
    postorder.reserve(size);
    treeParent.reserve(size);
  }

  void run(NodeId entry);

  std::vector<NodeId> nodes;            // by number
  std::vector<std::uint32_t> postorder; // numbers
  Lists<std::uint32_t> treeParent;
  Lists<std::uint32_t> backSources; // of edges that lead back to a node on the way to their source
  Lists<Edge> otherEdges;           // by the nearest node from which the search reached both ends

private:
  struct Frame { // as many as a program without branches has nodes
    std::uint32_t number;
    std::uint32_t firstSuccessor;
  };

  void enter(NodeId node);
  void follow(std::uint32_t from, NodeId to);

  const Cfg &cfg_;
  const ProgramModel &model_;
  ProgramUse use_;
  NodeId first_;
  std::vector<std::uint32_t> numbers_; // by node, from first_ on
  std::vector<bool> isLeft_;           // by number
  DisjointSets leftInto_{0};           // a node that is left, with the nearest one around it that is not
  std::vector<Frame> path_;
  std::vector<NodeId> successors_; // of the nodes on the path that are still to be followed
};

void Search::run(NodeId entry) {
  enter(entry);
  while (!path_.empty()) {
    const Frame frame = path_.back();
    if (successors_.size() > frame.firstSuccessor) {
      const NodeId to = successors_.back();
      successors_.pop_back();
      follow(frame.number, to);
      continue;
    }
    postorder.push_back(frame.number);
    isLeft_[frame.number] = true;
    path_.pop_back();
    if (!path_.empty())
      leftInto_.join(frame.number, path_.back().number);
  }
}

void Search::enter(NodeId node) {
  const auto number = static_cast<std::uint32_t>(nodes.size());
  numbers_[node.index() - first_.index()] = number;
  nodes.push_back(node);
  isLeft_.push_back(false);
  leftInto_.add();
  path_.push_back({number, static_cast<std::uint32_t>(successors_.size())});
  forEachSuccessor(cfg_, model_, node, use_, [&](NodeId successor) { successors_.push_back(successor); });
}

void Search::follow(std::uint32_t from, NodeId to) {
  const std::uint32_t number = numbers_[to.index() - first_.index()];
  if (number == kNone) {
    treeParent.add(static_cast<std::uint32_t>(nodes.size()), from);
    enter(to);
  } else if (!isLeft_[number]) {
    backSources.add(number, from);
  } else {
    otherEdges.add(leftInto_.rootOf(number), {from, number});
  }
}

/// For each number the head of the innermost loop around it, other than itself; kNone outside of loops.
std::vector<std::uint32_t> loopsAround(const Search &search) {
  const std::size_t size = search.nodes.size();
  std::vector<std::uint32_t> around(size, kNone);
  std::vector<std::uint32_t> taken(size, kNone); // the last head that took the number
  Lists<std::uint32_t> sources = search.treeParent;
  DisjointSets loops(size);
  std::vector<std::uint32_t> members;
  for (auto head = static_cast<std::uint32_t>(size); head-- > 0;) {
    search.otherEdges.forEach(head, [&](Edge edge) { sources.add(loops.rootOf(edge.to), edge.from); });
    members.clear();
    const auto take = [&](std::uint32_t source) {
      const std::uint32_t root = loops.rootOf(source);
      if (root == head || taken[root] == head)
        return;
      taken[root] = head;
      members.push_back(root);
    };
    search.backSources.forEach(head, take);
    for (std::size_t i = 0; i < members.size(); ++i)
      sources.forEach(members[i], take);
    for (const std::uint32_t member : members) {
      loops.join(member, head);
      around[member] = head;
    }
  }
  return around;
}

} // namespace

Wto::Wto(const Cfg &cfg, const ProgramModel &model, NodeId entry, ProgramUse use) : first_(entry) {
  const auto behind = std::upper_bound(cfg.entries.begin(), cfg.entries.end(), entry);
  first_ = behind == cfg.entries.begin() ? NodeId(0) : *std::prev(behind);
  const std::size_t last = behind == cfg.entries.end() ? cfg.nodes.size() : behind->index();
  Search search(cfg, model, use, first_, last - first_.index());
  search.run(entry);
  positions_.assign(last - first_.index(), kUnreachable);
  order_.reserve(search.nodes.size());
  if (search.backSources.isEmpty()) { // a tool path: without loops, and without memory for them
    for (auto number = search.postorder.rbegin(); number != search.postorder.rend(); ++number)
      append(search.nodes[*number]);
    return;
  }
  reserveForLoops(search.nodes.size());
  const std::vector<std::uint32_t> around = loopsAround(search);

  // By head, the last to be left last, so that `waiting` gives it back first; what is in no loop under `top`.
  Lists<std::uint32_t> inside;
  const auto top = static_cast<std::uint32_t>(search.nodes.size());
  for (auto number = search.postorder.rbegin(); number != search.postorder.rend(); ++number)
    inside.add(around[*number] == kNone ? top : around[*number], *number);

  std::vector<std::uint32_t> waiting;
  inside.forEach(top, [&](std::uint32_t number) { waiting.push_back(number); });
  while (!waiting.empty()) {
    const std::uint32_t number = waiting.back();
    waiting.pop_back();
    appendInLoops(search.nodes[number],
                  around[number] == kNone ? std::nullopt : std::optional(search.nodes[around[number]]),
                  search.backSources.isEmpty(number) ? Head::No : Head::Yes);
    inside.forEach(number, [&](std::uint32_t member) { waiting.push_back(member); });
  }
  // A component ends where the last one inside it does; what lies inside stands behind its head.
  for (std::size_t position = order_.size(); position-- > 0;)
    if (arounds_[position] != kNone)
      ends_[arounds_[position]] = std::max(ends_[arounds_[position]], ends_[position]);
}

void Wto::reserveForLoops(std::size_t size) {
  isHead_.reserve(size);
  depths_.reserve(size);
  arounds_.reserve(size);
  ends_.reserve(size);
}

void Wto::append(NodeId node) {
  positions_[node.index() - first_.index()] = static_cast<std::uint32_t>(order_.size());
  order_.push_back(node);
}

void Wto::appendInLoops(NodeId node, std::optional<NodeId> around, Head head) {
  append(node);
  isHead_.push_back(head == Head::Yes);
  const std::uint32_t depth = around ? depthOf(*around) : 0;
  depths_.push_back(depth + (head == Head::Yes ? 1 : 0));
  arounds_.push_back(around ? positionOf(*around) : kNone);
  ends_.push_back(static_cast<std::uint32_t>(order_.size()));
}

std::uint32_t Wto::positionOf(NodeId node) const {
  const bool known = node >= first_ && node.index() - first_.index() < positions_.size();
  return known ? positions_[node.index() - first_.index()] : kUnreachable;
}

bool Wto::isHead(NodeId node) const {
  const std::uint32_t position = positionOf(node);
  return position != kUnreachable && hasLoops() && isHead_[position];
}

NodeId Wto::headOf(NodeId node) const {
  const std::uint32_t position = positionOf(node);
  const bool own = position == kUnreachable || !hasLoops() || isHead_[position] || arounds_[position] == kNone;
  return own ? node : order_[arounds_[position]];
}

std::uint32_t Wto::depthOf(NodeId node) const {
  const std::uint32_t position = positionOf(node);
  return position == kUnreachable || !hasLoops() ? 0 : depths_[position];
}

std::uint32_t Wto::endOf(NodeId head) const {
  const std::uint32_t position = positionOf(head);
  if (position == kUnreachable)
    return kUnreachable;
  return hasLoops() ? ends_[position] : position + 1;
}

std::optional<NodeId> Wto::headAround(NodeId node) const {
  const std::uint32_t position = positionOf(node);
  if (position == kUnreachable || !hasLoops() || arounds_[position] == kNone)
    return std::nullopt;
  return order_[arounds_[position]];
}

} // namespace feedhold
