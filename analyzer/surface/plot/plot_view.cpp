#include "surface/plot/plot_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace feedhold {

namespace {

constexpr double kFullCircle = 2 * std::numbers::pi;

std::string shortened(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.')
    text.pop_back();
  return text == "-0" ? "0" : text;
}

/// The least of 1, 2, 5, 10, 20.. that is not below.
double roundStep(double least) {
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * power >= least * (1 - 1e-9))
      return step * power;
  return 10 * power;
}

/// Shares of an arc between which it turns by less than half a circle.  Of a helix of many turns the first is enough,
/// and what leads from there to its end.
std::vector<double> turningPoints(double sweep) {
  const double all = std::abs(sweep);
  const double whole = std::floor(all / kFullCircle + 1e-9) * kFullCircle;
  std::vector<double> shares;
  const auto add = [&](double from, double to) {
    const double pieces = std::ceil((to - from) / 3);
    for (double i = 1; i <= pieces; ++i)
      shares.push_back((from + (to - from) * i / pieces) / all);
  };
  if (whole > 0)
    add(0, kFullCircle);
  if (all - whole > 1e-9)
    add(whole, all);
  return shares;
}

std::string arcPath(const PlotView &view, const geometry::GougePath &path, const Plane &plane) {
  const bool isAlike = plane.first == view.across; // else it is seen from behind
  const bool turnsLeft = (path.sweep() > 0) == isAlike;
  const std::size_t first = indexOf(plane.first);
  const std::size_t second = indexOf(plane.second);
  std::string data;
  geometry::Point<double> from = path.start();
  const std::vector<double> shares = turningPoints(path.sweep());
  double before = 0;
  for (const double share : shares) {
    const geometry::Point<double> to = share > 1 - 1e-12 ? path.end() : path.at(share);
    const double angle = std::abs(path.sweep()) * (share - before);
    const double half = std::sin(std::fmod(angle, kFullCircle) / 2);
    const double chord = std::hypot(to[first] - from[first], to[second] - from[second]);
    const double radius = half < 1e-9 ? 0 : chord / 2 / half * view.scale;
    data += fmt::format("A{0} {0} 0 0 {1} {2} {3}", px(radius), turnsLeft ? 0 : 1, px(view.x(to)), px(view.y(to)));
    from = to;
    before = share;
  }
  return data;
}

} // namespace

void PlotRange::include(double value) {
  low = std::min(low, value);
  high = std::max(high, value);
}

std::string px(double value) { return shortened(value, 2); }
std::string plainNumber(double value) { return shortened(value, 4); }

std::string pathOf(const PlotView &view, const RecordedMove &recorded) {
  const geometry::GougePath path(recorded);
  const auto lineTo = [&](const geometry::Point<double> &point) {
    return fmt::format("L{} {}", px(view.x(point)), px(view.y(point)));
  };
  if (path.isStraight())
    return lineTo(path.end());
  const Plane &plane = recorded.move.plane;
  if (plane.normal != view.across && plane.normal != view.up)
    return arcPath(view, path, plane);
  constexpr std::size_t kPoints = 32; // of a round
  constexpr std::size_t kMostPoints = 4096;
  const std::size_t points = std::min(kPoints * path.rounds(), kMostPoints);
  std::string data;
  for (std::size_t i = 1; i <= points; ++i)
    data += lineTo(path.at(static_cast<double>(i) / static_cast<double>(points)));
  return data;
}

std::string drawAxes(const PlotView &view, std::string_view unit) {
  constexpr double kLeastDistance = 64; // of two numbers
  const double step = roundStep(kLeastDistance / view.scale);
  const double right = view.left + view.width();
  const double bottom = view.top + view.height();
  std::string text;
  const auto grid = [&](double x1, double y1, double x2, double y2, bool isZero) {
    text += fmt::format("<line class=\"{}\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>\n", isZero ? "zero" : "grid",
                        px(x1), px(y1), px(x2), px(y2));
  };
  const auto write = [&](double x, double y, std::string_view anchor, std::string_view what) {
    text += fmt::format("<text class=\"scale\" x=\"{}\" y=\"{}\" text-anchor=\"{}\">{}</text>\n", px(x), px(y), anchor,
                        what);
  };
  for (double i = std::ceil(view.acrossRange.low / step); i * step <= view.acrossRange.high; ++i) {
    const double x = view.left + view.x(i * step);
    grid(x, view.top, x, bottom, i == 0);
    write(x, bottom + 15, "middle", plainNumber(i * step));
  }
  for (double i = std::ceil(view.upRange.low / step); i * step <= view.upRange.high; ++i) {
    const double y = view.top + view.y(i * step);
    grid(view.left, y, right, y, i == 0);
    write(view.left - 6, y + 4, "end", plainNumber(i * step * (view.isLathe ? 2 : 1)));
  }
  const auto axis = [&](Axis shown) { return !view.isLathe ? letterOf(shown) : shown == Axis::X ? 'Z' : 'X'; };
  write(right, bottom + 30, "end", fmt::format("{} ({})", axis(view.across), unit));
  write(view.left - 6, view.top - 8, "end", fmt::format("{} ({})", axis(view.up), unit));
  return text + fmt::format("<rect class=\"frame\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n", px(view.left),
                            px(view.top), px(view.width()), px(view.height()));
}

} // namespace feedhold
