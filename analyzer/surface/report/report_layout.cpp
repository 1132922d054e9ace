#include "surface/report/report_layout.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace feedhold::certificate {

namespace {

constexpr std::size_t kSweeps = 12;
constexpr double kBesidePass = 0.6; // what is between two edges, or an edge and a node

class Layering {
public:
  Layering(std::size_t nodes, std::span<const LayoutEdge> edges)
      : edges_(edges), columns_(nodes), marks_(nodes, Mark::New), below_(nodes), isInRing_(nodes) {
    layout_.nodes.resize(nodes);
    layout_.routes.resize(edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i)
      below_[edges[i].from].push_back(i);
  }

  Layout run() {
    findRings();
    chooseColumns();
    addPasses();
    order();
    chooseRows();
    return std::move(layout_);
  }

private:
  enum class Mark { New, Open, Done };
  /// A node, or a place where an edge passes a column.
  struct Vertex {
    std::size_t column = 0;
    bool isNode = true;
    std::vector<std::size_t> before = {}; // in the column to the left
    std::vector<std::size_t> behind = {};
    double row = 0;
  };

  // ---- rings ----

  void findRings() {
    std::vector<bool> isCalled(marks_.size());
    for (const LayoutEdge &edge : edges_)
      if (edge.from != edge.to)
        isCalled[edge.to] = true;
    for (std::size_t i = 0; i < marks_.size(); ++i)
      if (!isCalled[i])
        visit(i);
    for (std::size_t i = 0; i < marks_.size(); ++i)
      visit(i);
    for (std::size_t i = 0; i < edges_.size(); ++i)
      if (layout_.routes[i].goesBack)
        markRing(edges_[i]);
    for (std::size_t i = 0; i < marks_.size(); ++i)
      layout_.nodes[i].inCycle = isInRing_[i];
  }
  void visit(std::size_t start) {
    if (marks_[start] != Mark::New)
      return;
    std::vector<std::pair<std::size_t, std::size_t>> path = {{start, 0}}; // and how many edges were followed
    marks_[start] = Mark::Open;
    met_.push_back(start);
    while (!path.empty()) {
      auto &[node, followed] = path.back();
      if (followed == below_[node].size()) {
        marks_[node] = Mark::Done;
        finished_.push_back(node);
        path.pop_back();
        continue;
      }
      const std::size_t edge = below_[node][followed++];
      const std::size_t next = edges_[edge].to;
      layout_.routes[edge].goesBack = marks_[next] == Mark::Open;
      if (marks_[next] != Mark::New)
        continue;
      marks_[next] = Mark::Open;
      met_.push_back(next);
      path.emplace_back(next, 0);
    }
  }
  /// All that lies on a way from the end of the edge to its beginning.
  void markRing(const LayoutEdge &back) {
    const std::vector<bool> below = reached(back.to, [](const LayoutEdge &edge) { return edge; });
    const std::vector<bool> above = reached(back.from, [](const LayoutEdge &edge) {
      return LayoutEdge{edge.to, edge.from};
    });
    for (std::size_t i = 0; i < below.size(); ++i)
      isInRing_[i] = isInRing_[i] || (below[i] && above[i]);
  }
  template <typename Direction> std::vector<bool> reached(std::size_t start, const Direction &direction) const {
    std::vector<bool> seen(marks_.size());
    seen[start] = true;
    for (bool isMore = true; std::exchange(isMore, false);)
      for (const LayoutEdge &each : edges_)
        if (const LayoutEdge edge = direction(each); seen[edge.from] && !seen[edge.to])
          seen[edge.to] = isMore = true;
    return seen;
  }

  // ---- columns ----

  void chooseColumns() {
    for (std::size_t i = finished_.size(); i-- > 0;)
      for (const std::size_t edge : below_[finished_[i]])
        if (!layout_.routes[edge].goesBack)
          columns_[edges_[edge].to] = std::max(columns_[edges_[edge].to], columns_[finished_[i]] + 1);
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      layout_.nodes[i].column = columns_[i];
      layout_.columns = std::max(layout_.columns, columns_[i] + 1);
    }
  }

  /// An edge over several columns is one of short ones.
  void addPasses() {
    for (const std::size_t column : columns_)
      vertices_.push_back({column});
    inColumn_.resize(layout_.columns);
    for (const std::size_t node : met_)
      inColumn_[columns_[node]].push_back(node);
    passesOf_.resize(edges_.size());
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      if (layout_.routes[i].goesBack)
        continue;
      std::size_t last = edges_[i].from;
      for (std::size_t column = columns_[edges_[i].from] + 1; column < columns_[edges_[i].to]; ++column) {
        vertices_.push_back({column, false});
        inColumn_[column].push_back(vertices_.size() - 1);
        passesOf_[i].push_back(vertices_.size() - 1);
        join(last, vertices_.size() - 1);
        last = vertices_.size() - 1;
      }
      join(last, edges_[i].to);
    }
  }
  void join(std::size_t before, std::size_t behind) {
    vertices_[before].behind.push_back(behind);
    vertices_[behind].before.push_back(before);
  }

  // ---- order within columns ----

  void order() {
    number();
    auto best = inColumn_;
    std::size_t fewest = crossings();
    for (std::size_t sweep = 0; sweep < kSweeps && fewest > 0; ++sweep) {
      for (std::size_t i = 0; i < inColumn_.size(); ++i)
        sort(sweep % 2 == 0 ? i : inColumn_.size() - 1 - i, sweep % 2 == 0 ? &Vertex::before : &Vertex::behind);
      if (const std::size_t now = crossings(); now < fewest) {
        fewest = now;
        best = inColumn_;
      }
    }
    inColumn_ = std::move(best);
    number();
  }
  void number() {
    for (const std::vector<std::size_t> &column : inColumn_)
      for (std::size_t i = 0; i < column.size(); ++i)
        vertices_[column[i]].row = static_cast<double>(i);
  }
  using Neighbours = std::vector<std::size_t> Vertex::*;
  double middleOf(const Vertex &vertex, Neighbours neighbours) const {
    const std::vector<std::size_t> &all = vertex.*neighbours;
    return all.empty() ? vertex.row : std::accumulate(all.begin(), all.end(), 0., [&](double sum, std::size_t each) {
                                        return sum + vertices_[each].row;
                                      }) / static_cast<double>(all.size());
  }
  void sort(std::size_t index, Neighbours neighbours) {
    std::vector<std::pair<double, std::size_t>> keys;
    for (const std::size_t each : inColumn_[index])
      keys.emplace_back(middleOf(vertices_[each], neighbours), each);
    std::stable_sort(keys.begin(), keys.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
    for (std::size_t i = 0; i < keys.size(); ++i) {
      inColumn_[index][i] = keys[i].second;
      vertices_[keys[i].second].row = static_cast<double>(i);
    }
  }
  std::size_t crossings() const {
    std::size_t count = 0;
    for (const std::vector<std::size_t> &column : inColumn_) {
      std::vector<std::pair<double, double>> lines;
      for (const std::size_t each : column)
        for (const std::size_t next : vertices_[each].behind)
          lines.emplace_back(vertices_[each].row, vertices_[next].row);
      for (std::size_t i = 0; i < lines.size(); ++i)
        for (std::size_t j = i + 1; j < lines.size(); ++j)
          count += (lines[i].first - lines[j].first) * (lines[i].second - lines[j].second) < 0 ? 1 : 0;
    }
    return count;
  }

  // ---- rows ----

  void chooseRows() {
    for (std::size_t sweep = 0; sweep < kSweeps; ++sweep)
      for (std::size_t i = 0; i < inColumn_.size(); ++i)
        place(inColumn_[sweep % 2 == 0 ? i : inColumn_.size() - 1 - i],
              sweep % 2 == 0 ? &Vertex::before : &Vertex::behind);
    double top = 0, bottom = 0;
    for (const Vertex &vertex : vertices_)
      top = std::min(top, vertex.row);
    for (Vertex &vertex : vertices_) {
      vertex.row -= top;
      bottom = std::max(bottom, vertex.row);
    }
    layout_.rows = bottom + 1;
    for (std::size_t i = 0; i < layout_.nodes.size(); ++i)
      layout_.nodes[i].row = vertices_[i].row;
    for (std::size_t i = 0; i < edges_.size(); ++i)
      for (const std::size_t pass : passesOf_[i])
        layout_.routes[i].passes.push_back(vertices_[pass].row);
  }
  /// Each beside its neighbours, and then all of the column back by what they were pushed.
  void place(const std::vector<std::size_t> &column, Neighbours neighbours) {
    std::vector<double> rows;
    double pushed = 0;
    for (std::size_t i = 0; i < column.size(); ++i) {
      const Vertex &vertex = vertices_[column[i]];
      const double wished = middleOf(vertex, neighbours);
      const bool isPass = i > 0 && !(vertex.isNode && vertices_[column[i - 1]].isNode);
      const double row = i == 0 ? wished : std::max(wished, rows.back() + (isPass ? kBesidePass : 1));
      pushed += row - wished;
      rows.push_back(row);
    }
    for (std::size_t i = 0; i < column.size(); ++i)
      vertices_[column[i]].row = rows[i] - pushed / static_cast<double>(column.size());
  }

  std::span<const LayoutEdge> edges_;
  std::vector<std::size_t> columns_;
  std::vector<Mark> marks_;
  std::vector<std::vector<std::size_t>> below_; // edges that leave each node
  std::vector<bool> isInRing_;
  std::vector<std::size_t> met_;      // nodes, each before what it leads to first
  std::vector<std::size_t> finished_; // nodes, each behind all that it leads to
  std::vector<Vertex> vertices_;      // nodes, then passes
  std::vector<std::vector<std::size_t>> inColumn_;
  std::vector<std::vector<std::size_t>> passesOf_; // of each edge
  Layout layout_;
};

} // namespace

std::vector<std::vector<std::size_t>> partsOf(std::size_t nodes, std::span<const LayoutEdge> edges) {
  std::vector<std::size_t> first(nodes); // the first node of the part that each belongs to
  std::iota(first.begin(), first.end(), std::size_t{0});
  for (bool isMore = true; std::exchange(isMore, false);)
    for (const LayoutEdge &edge : edges)
      if (first[edge.from] != first[edge.to]) {
        first[edge.from] = first[edge.to] = std::min(first[edge.from], first[edge.to]);
        isMore = true;
      }
  std::vector<std::vector<std::size_t>> byFirst(nodes);
  for (std::size_t i = 0; i < nodes; ++i)
    byFirst[first[i]].push_back(i);
  std::erase_if(byFirst, [](const std::vector<std::size_t> &part) { return part.empty(); });
  return byFirst;
}

Layout layoutOf(std::size_t nodes, std::span<const LayoutEdge> edges) { return Layering(nodes, edges).run(); }

} // namespace feedhold::certificate
