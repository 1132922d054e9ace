// Regions and tools as they are seen along an axis.
#include "base/support/match.h"
#include "surface/plot/plot_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace feedhold {

namespace {
using geometry::Condition;
using geometry::Prism;

/// Sides without a bound end this far outside of the view.
constexpr double kBeyond = 8;

class ShapeDrawing {
public:
  ShapeDrawing(const PlotView &view, std::string_view attributes) : view_(view), attributes_(attributes) {}

  std::string draw(const geometry::Box<double> &box) const {
    return rectangle(box.sides[indexOf(view_.across)], box.sides[indexOf(view_.up)]);
  }
  std::string draw(const geometry::Cylinder<double> &cylinder) const {
    const std::size_t along = indexOf(cylinder.axis);
    const auto centreOf = [&](Axis axis) { // of an axis across
      const bool isFirst = along == 0 ? axis == Axis::Y : indexOf(axis) == 0;
      return cylinder.centre[isFirst ? 0 : 1];
    };
    if (cylinder.axis != view_.across && cylinder.axis != view_.up)
      return circle(centreOf(view_.across), centreOf(view_.up), cylinder.radius);
    const auto side = [&](Axis axis) -> geometry::Interval<double> {
      if (axis == cylinder.axis)
        return cylinder.along;
      return {centreOf(axis) - cylinder.radius, centreOf(axis) + cylinder.radius};
    };
    return rectangle(side(view_.across), side(view_.up));
  }
  std::string draw(const geometry::Sphere<double> &sphere) const {
    return circle(sphere.centre[indexOf(view_.across)], sphere.centre[indexOf(view_.up)], sphere.radius);
  }
  std::string draw(const Prism<double> &prism) const {
    if (view_.up == Axis::Z)
      return sideOf(prism);
    std::string points;
    for (const auto &[x, y] : prism.corners)
      points += fmt::format("{}{},{}", points.empty() ? "" : " ", px(view_.x(x)), px(view_.y(y)));
    return fmt::format("<polygon {} points=\"{}\"/>\n", attributes_, points);
  }
  std::string draw(const Condition<double, bool> &) const { return {}; }

private:
  std::string rectangle(const geometry::Interval<double> &across, const geometry::Interval<double> &up) const {
    if (!across.low && !across.high && !up.low && !up.high)
      return {}; // everywhere: it would say nothing
    const double left = across.low ? view_.x(*across.low) : -kBeyond;
    const double right = across.high ? view_.x(*across.high) : view_.width() + kBeyond;
    const double top = up.high ? view_.y(*up.high) : -kBeyond;
    const double bottom = up.low ? view_.y(*up.low) : view_.height() + kBeyond;
    if (right < left || bottom < top)
      return {};
    return fmt::format("<rect {} x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n", attributes_, px(left), px(top),
                       px(right - left), px(bottom - top));
  }
  std::string circle(double across, double up, double radius) const {
    if (radius < 0)
      return {};
    return fmt::format("<circle {} cx=\"{}\" cy=\"{}\" r=\"{}\"/>\n", attributes_, px(view_.x(across)), px(view_.y(up)),
                       px(radius * view_.scale));
  }
  std::string sideOf(const Prism<double> &prism) const {
    const std::size_t axis = view_.across == Axis::X ? 0 : 1;
    const auto [least, most] = std::minmax_element(prism.corners.begin(), prism.corners.end(),
                                                   [&](const auto &a, const auto &b) { return a[axis] < b[axis]; });
    return rectangle({(*least)[axis], (*most)[axis]}, prism.height);
  }

  const PlotView &view_;
  std::string_view attributes_;
};

void include(PlotRange &range, const geometry::Interval<double> &interval) {
  for (const auto &end : {interval.low, interval.high})
    if (end)
      range.include(*end);
}

} // namespace

std::string drawShape(const PlotView &view, const geometry::PlainShape &shape, std::string_view attributes) {
  const ShapeDrawing drawing(view, attributes);
  return match(shape, [&](const auto &drawn) { return drawing.draw(drawn); });
}

std::string drawTool(const PlotView &view, const geometry::Tool<double> &tool, const geometry::Point<double> &point) {
  const double x = view.x(point);
  const double y = view.y(point);
  const double radius = tool.radius * view.scale;
  if (view.up != Axis::Z)
    return fmt::format("<circle class=\"tool\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>\n", px(x), px(y), px(radius));
  const double corner = tool.corner * view.scale;
  return fmt::format(
      "<path class=\"tool\" d=\"M{0} {1}L{0} {2}A{3} {3} 0 0 0 {4} {5}L{6} {5}A{3} {3} 0 0 0 {7} {2}L{7} "
      "{1}\"/>\n",
      px(x - radius), px(std::min(-kBeyond, y - corner - 1)), px(y - corner), px(corner), px(x - radius + corner),
      px(y), px(x + radius - corner), px(x + radius));
}

void include(std::array<PlotRange, 3> &ranges, const geometry::PlainShape &shape) {
  const auto round = [&](std::size_t axis, double centre, double radius) {
    include(ranges[axis], {centre - radius, centre + radius});
  };
  match(
      shape,
      [&](const geometry::Box<double> &box) {
        for (std::size_t axis = 0; axis < 3; ++axis)
          include(ranges[axis], box.sides[axis]);
      },
      [&](const geometry::Cylinder<double> &cylinder) {
        const std::size_t along = indexOf(cylinder.axis);
        include(ranges[along], cylinder.along);
        round(along == 0 ? 1 : 0, cylinder.centre[0], cylinder.radius);
        round(along == 2 ? 1 : 2, cylinder.centre[1], cylinder.radius);
      },
      [&](const geometry::Sphere<double> &sphere) {
        for (std::size_t axis = 0; axis < 3; ++axis)
          round(axis, sphere.centre[axis], sphere.radius);
      },
      [&](const Prism<double> &prism) {
        for (const auto &[x, y] : prism.corners) {
          ranges[0].include(x);
          ranges[1].include(y);
        }
        include(ranges[2], prism.height);
      },
      [](const Condition<double, bool> &) {});
}

} // namespace feedhold
