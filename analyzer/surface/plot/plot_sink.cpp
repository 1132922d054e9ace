#include "surface/plot/plot_sink.h"

#include "base/support/check.h"
#include "surface/plot/plot_view.h"
#include "surface/sink/xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace feedhold {

namespace {

using geometry::GougePath;

constexpr std::size_t kMostMoves = 200'000; // of a run; a viewer takes no more
constexpr double kFarthest = 1e8;           // no machine is as large
constexpr double kWidth = 940;
constexpr double kLeft = 64;
constexpr double kRight = 20;
constexpr double kMostHeight = 560; // of a view
constexpr double kBetween = 66;     // views
constexpr double kLine = 18;        // of text

/// Classes are those of the picture alone, so that it can stand in a page.  Colours of equal contrast on both grounds.
constexpr std::string_view kStyle = R"(<style>
.feedhold-plot text { font-family: system-ui, sans-serif; font-size: 12px; fill: #1f2328; }
.feedhold-plot .title { font-size: 15px; font-weight: 600; }
.feedhold-plot .scale { font-size: 11px; fill: #59636e; }
.feedhold-plot .wrong { fill: #b3161c; font-weight: 600; }
.feedhold-plot .paper { fill: #ffffff; }
.feedhold-plot .frame { fill: none; stroke: #59636e; }
.feedhold-plot .grid { stroke: #e4e8ec; }
.feedhold-plot .zero { stroke: #aeb6bf; }
.feedhold-plot .path { fill: none; stroke: #0a58ca; stroke-width: 1.6; stroke-linejoin: round; stroke-linecap: round; }
.feedhold-plot .rapid { stroke-dasharray: 6 4; stroke-width: 1.2; }
.feedhold-plot .contour { stroke: #59636e; stroke-width: 1; }
.feedhold-plot .other { stroke-dasharray: 1 4; }
.feedhold-plot .both { stroke-width: 3.4; }
.feedhold-plot .both.rapid { stroke-width: 2.4; }
.feedhold-plot .second { stroke: #c2500a; }
.feedhold-plot .mark { fill: #0a58ca; stroke: #ffffff; }
.feedhold-plot .mark.second { fill: #c2500a; }
.feedhold-plot .in { fill: #1a7f37; fill-opacity: 0.1; stroke: #1a7f37; }
.feedhold-plot .out { fill: #b3161c; fill-opacity: 0.14; stroke: #b3161c; stroke-dasharray: 8 2 2 2; }
.feedhold-plot .clearance { fill: none; stroke: #8250df; stroke-dasharray: 12 4; }
.feedhold-plot .travel { fill: none; stroke: #8250df; stroke-width: 2; }
.feedhold-plot .tool { fill: #57606a; fill-opacity: 0.22; stroke: #1f2328; stroke-width: 1.4; }
.feedhold-plot .gouge { fill: none; stroke: #b3161c; stroke-width: 2; }
@media screen and (prefers-color-scheme: dark) {
.feedhold-plot text { fill: #e6edf3; }
.feedhold-plot .scale { fill: #9198a1; }
.feedhold-plot .wrong { fill: #ff7b72; }
.feedhold-plot .paper { fill: #0d1117; }
.feedhold-plot .frame { stroke: #9198a1; }
.feedhold-plot .grid { stroke: #21262d; }
.feedhold-plot .zero { stroke: #484f58; }
.feedhold-plot .path { stroke: #58a6ff; }
.feedhold-plot .contour { stroke: #9198a1; }
.feedhold-plot .second { stroke: #ffa657; }
.feedhold-plot .mark { fill: #58a6ff; stroke: #0d1117; }
.feedhold-plot .mark.second { fill: #ffa657; }
.feedhold-plot .in { fill: #3fb950; stroke: #3fb950; }
.feedhold-plot .out { fill: #ff7b72; stroke: #ff7b72; }
.feedhold-plot .clearance, .feedhold-plot .travel { stroke: #bc8cff; }
.feedhold-plot .tool { fill: #9198a1; stroke: #e6edf3; }
.feedhold-plot .gouge { stroke: #ff7b72; }
}
</style>
)";

std::string_view nameOf(LengthUnit unit) { return unit == LengthUnit::Inch ? "in" : "mm"; }

/// In another unit of length.
RecordedMove converted(RecordedMove recorded, LengthUnit unit) {
  if (recorded.unit == unit)
    return recorded;
  const double factor = unit == LengthUnit::Inch ? 1 / 25.4 : 25.4;
  for (auto *point : {&recorded.move.start, &recorded.move.end})
    for (ConcreteValue &value : *point)
      value.number *= factor;
  recorded.move.firstCentre.number *= factor;
  recorded.move.secondCentre.number *= factor;
  for (double &zero : recorded.zero)
    zero *= factor;
  recorded.unit = unit;
  return recorded;
}

/// `recorded`: as programmed where it has a path of the centre, which is drawn beside it.
std::string_view classOf(const RecordedMove &recorded) {
  if (!recorded.centre.empty())
    return "path contour";
  switch (recorded.move.kind) {
  case MoveKind::Rapid: return "path rapid";
  case MoveKind::Feed:
  case MoveKind::CutInBox:
  case MoveKind::ArcClockwise:
  case MoveKind::ArcCounterclockwise: return recorded.isOfTool ? "path" : "path other";
  case MoveKind::Dwell: return "";
  case MoveKind::Probe:
  case MoveKind::Unmodelled: return "path other";
  }
  FEEDHOLD_UNREACHABLE("the switch names every kind");
}

/// The moves of one run that are drawn, in the unit of the picture.
struct DrawnRun {
  const PlottedRun *run;
  std::vector<RecordedMove> moves;
  std::string_view role; // a class: which of several runs
};

class Drawing {
public:
  explicit Drawing(const Picture &picture) : picture_(picture) {
    const auto moving = std::find_if(picture.runs.begin(), picture.runs.end(),
                                     [](const PlottedRun &run) { return !run.moves.empty(); });
    if (moving != picture.runs.end())
      unit_ = moving->moves.front().unit;
    for (std::size_t i = 0; i < picture.runs.size(); ++i)
      runs_.push_back(drawn(picture.runs[i], picture.runs.size() < 2 ? "" : i == 0 ? " both" : " second"));
    if (picture.gouge && picture.gouge->gouge.move < picture.runs.front().moves.size())
      gougeAt_ = placeOf(*picture.gouge);
  }

  std::string draw() {
    writeHead();
    findRanges();
    const double scale = std::min((kWidth - kLeft - kRight) / ranges_[0].size(),
                                  kMostHeight / std::max(ranges_[1].size(), ranges_[2].size()));
    widen(ranges_[0], (kWidth - kLeft - kRight) / scale);
    for (const Axis up : upwards())
      addView({Axis::X, up, ranges_[0], ranges_[indexOf(up)], scale, kLeft, bottom_, picture_.isLathe});
    if (gougeAt_)
      addDetails(scale);
    addLegend();
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"feedhold-plot\" role=\"img\" viewBox=\"0 0 {0} "
        "{1}\" width=\"{0}\" height=\"{1}\">\n<title>{2}</title>\n{3}<rect class=\"paper\" "
        "width=\"{0}\" height=\"{1}\"/>\n{4}</svg>\n",
        px(kWidth), px(std::ceil(bottom_)), xml(picture_.title), kStyle, body_);
  }

private:
  DrawnRun drawn(const PlottedRun &run, std::string_view role) {
    DrawnRun result{&run, {}, role};
    for (const RecordedMove &move : run.moves.first(std::min(run.moves.size(), kMostMoves))) {
      if (move.move.kind == MoveKind::Dwell)
        continue;
      if (!isNear(move)) {
        ++tooFar_;
        continue;
      }
      RecordedMove &programmed = result.moves.emplace_back(inSpace(converted(move, unit_)));
      programmed.centre = move.centre; // that there is one: classOf
      if (!move.centre.empty())
        for (const RecordedMove &step : movesOfCentre(move))
          result.moves.push_back(inSpace(converted(step, unit_)));
    }
    return result;
  }

  RecordedMove inSpace(const RecordedMove &move) const {
    return picture_.isLathe ? geometry::inHalfPlane(move, {0, 0}, 0) : move;
  }
  /// Of the tool: on a lathe the centre of its nose.
  geometry::Point<double> placeOf(const PlottedGouge &gouge) const {
    const geometry::PlainSpace &space = picture_.space;
    return space.tip ? geometry::toHalfPlane(gouge.gouge.at, *space.tip, space.tool ? space.tool->radius : 0)
                     : gouge.gouge.at;
  }
  std::vector<Axis> upwards() const { return picture_.isLathe ? std::vector{Axis::Y} : std::vector{Axis::Y, Axis::Z}; }

  static bool isNear(const RecordedMove &move) {
    const GougePath path(move);
    return path.length() < kFarthest && std::all_of(path.start().begin(), path.start().end(),
                                                    [](double coordinate) { return std::abs(coordinate) < kFarthest; });
  }

  // ---- text above ----

  void line(std::string_view style, std::string_view text) {
    constexpr std::size_t kMost = 100; // characters of a line
    while (!text.empty()) {
      const std::size_t blank = text.size() > kMost ? text.rfind(' ', kMost) : std::string_view::npos;
      bottom_ += kLine;
      body_ += fmt::format("<text class=\"{}\" x=\"{}\" y=\"{}\">{}</text>\n", style, px(kLeft), px(bottom_),
                           xml(text.substr(0, blank)));
      text.remove_prefix(blank == std::string_view::npos ? text.size() : blank + 1);
    }
  }
  void writeHead() {
    bottom_ = 8;
    line("title", picture_.title);
    if (picture_.gouge)
      line("wrong", picture_.gouge->text);
    for (const std::string &note : picture_.notes)
      line("note", note);
    for (const PlottedRun &run : picture_.runs)
      if (run.moves.size() > kMostMoves)
        line("note", fmt::format("only the first {} of {} moves are drawn", kMostMoves, run.moves.size()));
    if (tooFar_ > 0)
      line("note", fmt::format("{} moves are too far away to be drawn", tooFar_));
    for (const auto *regions : {&picture_.space.keepIn, &picture_.space.keepOut})
      for (const geometry::PlainRegion &region : *regions)
        if (!std::all_of(region.parts.begin(), region.parts.end(), isDrawn))
          line("note", fmt::format("{} is a WHERE region, which is not drawn", region.name));
    bottom_ += 34;
  }
  static bool isDrawn(const geometry::PlainShape &shape) {
    return !std::holds_alternative<geometry::Condition<double, bool>>(shape);
  }

  // ---- what is in sight ----

  void findRanges() {
    bool isFirst = true;
    for (const DrawnRun &run : runs_)
      for (const RecordedMove &move : run.moves) {
        const GougePath path(move);
        for (const double share : path.extremes()) {
          const geometry::Point<double> point = path.at(share);
          for (std::size_t axis = 0; axis < 3; ++axis) {
            if (isFirst)
              ranges_[axis] = {point[axis], point[axis]};
            ranges_[axis].include(point[axis]);
          }
          isFirst = false;
        }
      }
    const std::array path = ranges_;
    std::array wanted = ranges_;
    for (const auto *regions : {&picture_.space.keepIn, &picture_.space.keepOut})
      for (const geometry::PlainRegion &region : *regions)
        for (const geometry::PlainShape &shape : region.parts)
          include(wanted, shape);
    if (picture_.space.clearance)
      wanted[2].include(*picture_.space.clearance);
    double largest = 1;
    for (const PlotRange &range : path)
      largest = std::max(largest, range.size());
    // Regions are seen as far as the path is long beside it: a wall of metres would leave nothing of the path.
    const double tool = picture_.space.tool ? picture_.space.tool->radius : 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ranges_[axis].low = std::min(path[axis].low - tool, std::max(wanted[axis].low, path[axis].low - largest));
      ranges_[axis].high = std::max(path[axis].high + tool, std::min(wanted[axis].high, path[axis].high + largest));
      widen(ranges_[axis], ranges_[axis].size() + largest * 0.12);
    }
  }
  static void widen(PlotRange &range, double size) {
    const double more = std::max(0.0, size - range.size()) / 2;
    range = {range.low - more, range.high + more};
  }

  // ---- a view ----

  void addView(const PlotView &view) {
    body_ += drawAxes(view, nameOf(unit_));
    // Cut off at its edges, by a picture in the picture.
    body_ += fmt::format("<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\">\n", px(view.left), px(view.top),
                         px(view.width()), px(view.height()));
    addSpace(view);
    for (const DrawnRun &run : runs_)
      addPaths(view, run);
    for (const DrawnRun &run : runs_)
      addMarks(view, run);
    if (gougeAt_)
      addGouge(view);
    body_ += "</svg>\n";
    bottom_ = std::max(bottom_, view.top + view.height() + kBetween);
  }
  void addSpace(const PlotView &view) {
    const auto regions = [&](const std::vector<geometry::PlainRegion> &all, std::string_view style) {
      for (const geometry::PlainRegion &region : all) {
        body_ += fmt::format("<g><title>{}</title>\n", xml(region.name));
        for (const geometry::PlainShape &shape : region.parts)
          body_ += drawShape(view, shape, fmt::format("class=\"{}\"", style));
        body_ += "</g>\n";
      }
    };
    regions(picture_.space.keepIn, "in");
    regions(picture_.space.keepOut, "out");
    if (picture_.space.travel)
      body_ += drawShape(view, *picture_.space.travel, "class=\"travel\"");
    if (const auto height = picture_.space.clearance; height && view.up == Axis::Z)
      body_ += fmt::format("<line class=\"clearance\" x1=\"0\" x2=\"{}\" y1=\"{}\" y2=\"{}\"><title>clearance</title>"
                           "</line>\n",
                           px(view.width()), px(view.y(*height)), px(view.y(*height)));
  }

  /// All moves that a block makes in one manner are one path, so that it can be pointed at.
  void addPaths(const PlotView &view, const DrawnRun &run) {
    struct Path {
      std::string data;
      std::string end; // of the last step
      const RecordedMove *first;
      std::string_view style;
    };
    std::vector<Path> paths;
    std::map<std::pair<Place, std::string_view>, std::size_t> known;
    for (const RecordedMove &move : run.moves) {
      const std::string_view style = classOf(move);
      const auto [at, isNew] = known.try_emplace({move.place, style}, paths.size());
      if (isNew)
        paths.push_back({"", "", &move, style});
      Path &path = paths[at->second];
      const GougePath way(move);
      const auto step = [&](const geometry::Point<double> &point) {
        return fmt::format("{} {}", px(view.x(point)), px(view.y(point)));
      };
      if (const std::string start = step(way.start()); path.end != start)
        path.data += 'M' + start;
      path.data += pathOf(view, move);
      path.end = step(way.end());
    }
    for (const Path &path : paths) {
      const std::string block = run.run->blockOf ? run.run->blockOf(*path.first) : std::string();
      body_ += fmt::format("<path class=\"{}{}\" d=\"{}\">", path.style, run.role, path.data);
      body_ += block.empty() ? std::string("</path>\n") : fmt::format("<title>{}</title></path>\n", xml(block));
    }
  }
  void addMarks(const PlotView &view, const DrawnRun &run) {
    if (run.moves.empty())
      return;
    const geometry::Point<double> start = GougePath(run.moves.front()).start();
    const geometry::Point<double> end = GougePath(run.moves.back()).end();
    body_ += fmt::format("<circle class=\"mark{}\" cx=\"{}\" cy=\"{}\" r=\"5\"><title>start</title></circle>\n",
                         run.role, px(view.x(start)), px(view.y(start)));
    body_ +=
        fmt::format("<rect class=\"mark{}\" x=\"{}\" y=\"{}\" width=\"8\" height=\"8\"><title>end</title></rect>\n",
                    run.role, px(view.x(end) - 4), px(view.y(end) - 4));
  }
  void addGouge(const PlotView &view) {
    const double x = view.x(*gougeAt_);
    const double y = view.y(*gougeAt_);
    if (picture_.space.tool)
      body_ += drawTool(view, *picture_.space.tool, *gougeAt_);
    body_ += fmt::format("<path class=\"gouge\" d=\"M{} {}l10 10m0 -10l-10 10\"><title>{}</title></path>\n", px(x - 5),
                         px(y - 5), xml(picture_.gouge->text));
  }

  /// Both views again, so near that the tool fills them or the gouge can be seen.
  void addDetails(double scale) {
    const double size = (kWidth - kLeft * 2 - kRight) / 2;
    const double radius = picture_.space.tool ? picture_.space.tool->radius : 0;
    const double reach = std::max(radius * 1.5, picture_.gouge->gouge.depth * 4);
    if (size / 2 / reach < scale * 1.5)
      return; // as large as it is above
    const auto around = [&](Axis axis) {
      const double middle = (*gougeAt_)[indexOf(axis)];
      return PlotRange{middle - reach, middle + reach};
    };
    const double top = bottom_;
    double left = kLeft;
    for (const Axis up : upwards()) {
      addView({Axis::X, up, around(Axis::X), around(up), size / 2 / reach, left, top, picture_.isLathe});
      left += size + kLeft;
    }
  }

  // ---- what the signs mean ----

  void addLegend() {
    struct Sign {
      std::string drawn; // from 0 to 28, in a height of 12
      std::string text;
    };
    std::vector<Sign> signs;
    const auto stroke = [](std::string_view style) {
      return fmt::format("<path class=\"{}\" d=\"M0 6L28 6\"/>", style);
    };
    const auto area = [](std::string_view style) {
      return fmt::format("<rect class=\"{}\" width=\"28\" height=\"12\"/>", style);
    };
    if (runs_.size() > 1)
      for (const DrawnRun &run : runs_)
        signs.push_back({stroke(fmt::format("path{}", run.role)), run.run->name});
    signs.push_back({stroke("path"), "cutting"});
    signs.push_back({stroke("path rapid"), "rapid"});
    if (std::any_of(runs_.begin(), runs_.end(), [](const DrawnRun &run) { return has(run, "path contour"); }))
      signs.push_back({stroke("path contour"), "programmed, with cutter compensation"});
    if (std::any_of(runs_.begin(), runs_.end(), [](const DrawnRun &run) { return has(run, "path other"); }))
      signs.push_back({stroke("path other"), "unknown, or the programmed path with cutter compensation"});
    signs.push_back({"<circle class=\"mark\" cx=\"14\" cy=\"6\" r=\"5\"/>", "start"});
    signs.push_back({"<rect class=\"mark\" x=\"10\" y=\"2\" width=\"8\" height=\"8\"/>", "end"});
    for (const geometry::PlainRegion &region : picture_.space.keepIn)
      signs.push_back({area("in"), "keep in " + region.name});
    for (const geometry::PlainRegion &region : picture_.space.keepOut)
      signs.push_back({area("out"), "keep out of " + region.name});
    if (picture_.space.clearance)
      signs.push_back({stroke("clearance"), "clearance Z" + plainNumber(*picture_.space.clearance)});
    if (picture_.space.travel)
      signs.push_back({stroke("travel"), "travel"});
    if (gougeAt_ && picture_.space.tool)
      signs.push_back({area("tool"), "tool at the gouge"});
    bottom_ -= kBetween - 48;
    double left = kLeft;
    for (const Sign &sign : signs) {
      const double width = 28 + 8 + 7.2 * static_cast<double>(sign.text.size()) + 16;
      if (left > kLeft && left + width > kWidth - kRight) {
        left = kLeft;
        bottom_ += kLine + 4;
      }
      body_ += fmt::format("<g transform=\"translate({} {})\">{}<text x=\"36\" y=\"10\">{}</text></g>\n", px(left),
                           px(bottom_), sign.drawn, xml(sign.text));
      left += width;
    }
    bottom_ += kLine + 14;
  }
  static bool has(const DrawnRun &run, std::string_view style) {
    return std::any_of(run.moves.begin(), run.moves.end(),
                       [&](const RecordedMove &move) { return classOf(move) == style; });
  }

  const Picture &picture_;
  LengthUnit unit_ = LengthUnit::Millimetre;
  std::size_t tooFar_ = 0; // movements
  std::vector<DrawnRun> runs_;
  std::optional<geometry::Point<double>> gougeAt_;
  std::array<PlotRange, 3> ranges_{};
  double bottom_ = 0; // of what has been drawn
  std::string body_;
};

} // namespace

std::string drawPicture(const Picture &picture) { return Drawing(picture).draw(); }

std::string gougeText(const geometry::PlainSpace &space, geometry::SpaceClaim claim, std::size_t region,
                      const geometry::Gouge &gouge, LengthUnit unit, std::string_view place) {
  const std::string number = gouge.depth < 1e-4 ? "less than 0.0001" : plainNumber(gouge.depth);
  const std::string beside =
      gouge.beside > 0 ? fmt::format(", up to {} {} beside its path", plainNumber(gouge.beside), nameOf(unit)) : "";
  const auto text = [&](std::string_view where) {
    return fmt::format("{} {} {} at {}{}", number, nameOf(unit), where, place, beside);
  };
  switch (claim) {
  case geometry::SpaceClaim::KeepIn: return text("outside " + space.keepIn[region].name);
  case geometry::SpaceClaim::KeepOut: return text("inside " + space.keepOut[region].name);
  case geometry::SpaceClaim::Clearance: return text("below the clearance height in a rapid move");
  case geometry::SpaceClaim::Travel: return text("outside the travel limits");
  case geometry::SpaceClaim::Machine: return text("outside the range of the machine");
  }
  FEEDHOLD_UNREACHABLE("the switch names every claim");
}

} // namespace feedhold
