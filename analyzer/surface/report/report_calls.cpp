// The call graph: a drawing of each connected part, and the same as a list.
#include "surface/report/report_html.h"
#include "surface/report/report_layout.h"

#include <algorithm>
#include <map>
#include <set>

namespace feedhold::certificate {

namespace {

// Beyond these a drawing is not readable on a page.
constexpr std::size_t kMostNodes = 80;
constexpr std::size_t kMostColumns = 8;
constexpr double kMostRows = 26;

constexpr double kBoxHeight = 40, kRowHeight = 54, kGap = 56, kMargin = 4;
constexpr double kUnderRows = 36, kUnderSelf = 18; // for lines that close a cycle
constexpr double kLetter = 9, kSmallLetter = 6.6;
constexpr std::size_t kMostLetters = 26;

struct CallNode {
  std::string name; // as text
  std::string title;
  std::string link; // empty: it has no section
  Look look;
};

struct CallEdge {
  std::size_t from = 0;
  std::size_t to = 0;
  std::set<std::uint64_t> lines = {};
};

std::string linesOf(const CallEdge &edge) {
  return fmt::format("line{} {}", edge.lines.size() == 1 ? "" : "s", fmt::join(edge.lines, ", "));
}

bool beginsLetter(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }
double lengthOf(std::string_view name) {
  return static_cast<double>(std::count_if(name.begin(), name.end(), beginsLetter));
}
std::string shortened(const std::string &name) {
  std::size_t letters = 0;
  for (std::size_t i = 0; i < name.size(); ++i)
    if (beginsLetter(name[i]) && ++letters > kMostLetters)
      return name.substr(0, i) + "…";
  return name;
}

class CallDrawing {
public:
  CallDrawing(std::vector<CallNode> nodes, std::vector<CallEdge> edges, std::string id)
      : nodes_(std::move(nodes)), edges_(std::move(edges)), id_(std::move(id)) {}

  std::string write() {
    std::string drawing;
    if (nodes_.size() <= kMostNodes)
      drawing = draw();
    std::string html = fmt::format("<div class=\"call-part\">\n{}", drawing);
    if (drawing.empty())
      html += fmt::format("<p>{} are connected by calls: too many to draw. The list shows all calls.</p>\n",
                          counted(nodes_.size(), "program"));
    return html + list() + "</div>\n";
  }

private:
  std::string draw() {
    std::vector<LayoutEdge> lines;
    for (const CallEdge &edge : edges_)
      lines.push_back({edge.from, edge.to});
    layout_ = layoutOf(nodes_.size(), lines);
    if (layout_.columns > kMostColumns || layout_.rows > kMostRows)
      return {};
    placeColumns();
    const bool hasCycle =
        std::any_of(layout_.routes.begin(), layout_.routes.end(), [](const auto &route) { return route.goesBack; });
    const double height = 2 * kMargin + (layout_.rows - 1) * kRowHeight + kBoxHeight + (hasCycle ? kUnderRows : 0);
    const double width = columns_.back().first + columns_.back().second + kMargin;
    svg_ = fmt::format("<svg class=\"call-graph\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
                       "role=\"group\" aria-label=\"Drawing of calls\" aria-describedby=\"{2}\">\n",
                       width, height, id_);
    for (std::size_t i = 0; i < edges_.size(); ++i)
      line(edges_[i], layout_.routes[i]);
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      box(i);
    svg_ += "</svg>\n";
    if (hasCycle)
      svg_ +=
          "<p><small>A dashed line closes a cycle: a program calls itself, directly or through others.</small></p>\n";
    return std::move(svg_);
  }

  std::string wordOf(std::size_t i) const {
    return fmt::format("{} {}{}", nodes_[i].look.sign, nodes_[i].look.word,
                       layout_.nodes[i].inCycle ? ", in a cycle" : "");
  }
  void placeColumns() {
    columns_.assign(layout_.columns, {0, 96});
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      double &width = columns_[layout_.nodes[i].column].second;
      width = std::max(
          {width, 26 + kLetter * lengthOf(shortened(nodes_[i].name)), 26 + kSmallLetter * lengthOf(wordOf(i))});
    }
    double x = kMargin;
    for (auto &[left, width] : columns_) {
      left = x;
      x += width + kGap;
    }
  }
  static double middleOf(double row) { return kMargin + row * kRowHeight + kBoxHeight / 2; }

  void line(const CallEdge &edge, const Layout::Route &route) {
    const Layout::Node &from = layout_.nodes[edge.from], &to = layout_.nodes[edge.to];
    std::string path, head;
    if (route.goesBack) {
      const bool isSelf = edge.from == edge.to;
      const double x1 = columns_[from.column].first + columns_[from.column].second / 2 + (isSelf ? 16 : 0);
      const double x2 = columns_[to.column].first + columns_[to.column].second / 2 - (isSelf ? 16 : 0);
      const double y1 = middleOf(from.row) + kBoxHeight / 2, y2 = middleOf(to.row) + kBoxHeight / 2;
      const double under = std::max(y1, y2) + (isSelf ? kUnderSelf : kUnderRows);
      path = fmt::format("M{0:.1f} {1:.1f}C{0:.1f} {2:.1f} {3:.1f} {2:.1f} {3:.1f} {4:.1f}", x1, y1, under, x2, y2 + 7);
      head = fmt::format("M{0:.1f} {1:.1f}l-4 8h8z", x2, y2);
    } else {
      double x = columns_[from.column].first + columns_[from.column].second, y = middleOf(from.row);
      path = fmt::format("M{:.1f} {:.1f}", x, y);
      const auto curve = [&](double nextX, double nextY) {
        path += fmt::format("C{0:.1f} {1:.1f} {0:.1f} {2:.1f} {3:.1f} {2:.1f}", (x + nextX) / 2, y, nextY, nextX);
        y = nextY;
      };
      for (std::size_t i = 0; i < route.passes.size(); ++i) {
        const auto [left, width] = columns_[from.column + 1 + i];
        curve(left, middleOf(route.passes[i]));
        x = left + width;
        path += fmt::format("H{:.1f}", x);
      }
      const double end = columns_[to.column].first;
      curve(end - 7, middleOf(to.row));
      head = fmt::format("M{:.1f} {:.1f}l-8 -4v8z", end, middleOf(to.row));
    }
    svg_ += fmt::format("<g class=\"call{}\"><title>{} calls {}, {}</title><path class=\"line\" d=\"{}\"/><path "
                        "class=\"head\" d=\"{}\"/></g>\n",
                        route.goesBack ? " back" : "", xml(nodes_[edge.from].name), xml(nodes_[edge.to].name),
                        linesOf(edge), path, head);
  }

  /// Proved: round corners; refuted: none, and a thick line; an alarm: pointed; the rest dashed or dotted by the style.
  void box(std::size_t i) {
    const CallNode &node = nodes_[i];
    const auto [left, width] = columns_[layout_.nodes[i].column];
    const double top = middleOf(layout_.nodes[i].row) - kBoxHeight / 2;
    const bool isLink = !node.link.empty();
    svg_ += isLink ? fmt::format("<a class=\"node {}\" href=\"#{}\">", node.look.style, node.link)
                   : fmt::format("<g class=\"node {}\">", node.look.style);
    svg_ += fmt::format("<title>{}{}{}</title>", xml(node.name), node.title.empty() ? "" : ": ", xml(node.title));
    if (node.look.style == "alarms")
      svg_ += fmt::format("<path class=\"box\" d=\"M{:.1f} {:.1f}h{:.1f}l8 20l-8 20h-{:.1f}l-8 -20z\"/>", left + 8, top,
                          width - 16, width - 16);
    else
      svg_ +=
          fmt::format("<rect class=\"box\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.0f}\" rx=\"{}\"/>",
                      left, top, width, kBoxHeight, node.look.style == "refuted" ? 0 : 8);
    svg_ += fmt::format(
        "<text class=\"label\" x=\"{0:.1f}\" y=\"{1:.1f}\">{3}</text><text class=\"word\" x=\"{0:.1f}\" "
        "y=\"{2:.1f}\">{4}</text>{5}\n",
        left + width / 2, top + 17, top + 32, xml(shortened(node.name)), wordOf(i), isLink ? "</a>" : "</g>");
  }

  /// The same in words.
  std::string list() const {
    std::string html = fmt::format("<ul class=\"calls\" id=\"{}\">\n", id_);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      std::string calls;
      for (const CallEdge &edge : edges_)
        if (edge.from == i)
          calls +=
              fmt::format("{}{}{} <small>{}</small>", calls.empty() ? "" : ", ", nameOf(edge.to),
                          nodes_[edge.to].look.style == "missing" ? std::string(" (not supplied: it may do anything)")
                                                                  : std::string(),
                          linesOf(edge));
      if (!calls.empty())
        html += fmt::format("<li>{} calls {}</li>\n", nameOf(i), calls);
    }
    return html + "</ul>\n";
  }
  std::string nameOf(std::size_t i) const {
    return nodes_[i].link.empty()
               ? fmt::format("<b>{}</b>", xml(nodes_[i].name))
               : fmt::format("<a class=\"name\" href=\"#{}\">{}</a>", nodes_[i].link, xml(nodes_[i].name));
  }

  std::vector<CallNode> nodes_;
  std::vector<CallEdge> edges_;
  std::string id_;
  Layout layout_;
  std::vector<std::pair<double, double>> columns_; // left end and width
  std::string svg_;
};

class Calls {
public:
  explicit Calls(const Json &document) {
    for (const Json &file : document.at("files"))
      for (const Json &program : file.at("programs"))
        add(file.at("path").get<std::string>() + "|" + program.at("name").get<std::string>(),
            {program.at("name"), program.at("title"), anchorOf(file, program), lookOfStatus(program.at("status"))});
    for (const Json &file : document.at("files"))
      for (const Json &program : file.at("programs"))
        for (const Json &call : program.at("calls"))
          add(call);
  }

  std::string write() const {
    if (edges_.empty())
      return {};
    std::string html = "<section id=\"calls\">\n<h2>Who calls whom</h2>\n<p>Each program is to the right of its "
                       "callers. The label shows how far it is proved.</p>\n";
    std::vector<LayoutEdge> lines;
    for (const CallEdge &edge : edges_)
      lines.push_back({edge.from, edge.to});
    std::size_t drawn = 0;
    std::string alone;
    for (const std::vector<std::size_t> &part : partsOf(nodes_.size(), lines)) {
      std::vector<CallEdge> edges = within(part);
      if (edges.empty()) {
        const CallNode &node = nodes_[part.front()];
        alone += fmt::format("{}<a href=\"#{}\">{}</a>", alone.empty() ? "" : ", ", node.link, xml(node.name));
        continue;
      }
      std::vector<CallNode> nodes;
      for (const std::size_t node : part)
        nodes.push_back(nodes_[node]);
      html += CallDrawing(std::move(nodes), std::move(edges), fmt::format("calls-{}", ++drawn)).write();
    }
    if (!alone.empty())
      html += fmt::format("<p>No calls from or to: {}.</p>\n", alone);
    return html + "</section>\n";
  }

private:
  std::size_t add(const std::string &key, CallNode node) {
    const auto [at, isNew] = byKey_.try_emplace(key, nodes_.size());
    if (isNew)
      nodes_.push_back(std::move(node));
    return at->second;
  }
  void add(const Json &call) {
    const std::string from = call.at("fromPath").get<std::string>() + "|" + call.at("from").get<std::string>();
    const std::string to = call.at("to");
    const bool isThere = !call.at("path").is_null();
    const Look notProved{"outside", "–", "not in this report"}, missing{"missing", "∅", "not supplied"};
    const std::size_t caller = add(from, {call.at("from"), {}, {}, notProved});
    // What is computed may be another program at each place.
    const std::size_t callee =
        isThere ? add(call.at("path").get<std::string>() + "|" + to, {to, {}, {}, notProved})
                : add((to.starts_with("a program") ? from : std::string()) + "|" + to, {to, {}, {}, missing});
    const auto [at, isNew] = edgeOf_.try_emplace({caller, callee}, edges_.size());
    if (isNew)
      edges_.push_back({caller, callee});
    edges_[at->second].lines.insert(call.at("line").get<std::uint64_t>());
  }
  /// Numbered anew.
  std::vector<CallEdge> within(const std::vector<std::size_t> &part) const {
    std::map<std::size_t, std::size_t> anew;
    for (const std::size_t node : part)
      anew.emplace(node, anew.size());
    std::vector<CallEdge> edges;
    for (const CallEdge &edge : edges_)
      if (anew.contains(edge.from))
        edges.push_back({anew.at(edge.from), anew.at(edge.to), edge.lines});
    return edges;
  }

  std::vector<CallNode> nodes_;
  std::vector<CallEdge> edges_;
  std::map<std::string, std::size_t> byKey_; // by path and name
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> edgeOf_;
};

} // namespace

std::string callsOf(const Json &document) { return Calls(document).write(); }

} // namespace feedhold::certificate
