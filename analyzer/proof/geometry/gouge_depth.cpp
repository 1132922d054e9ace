#include "proof/geometry/gouge_depth.h"

#include "base/support/match.h"
#include "proof/geometry/gouge_samples.h"

#include <algorithm>
#include <cmath>

namespace feedhold::geometry {

namespace {

/// Of a number from an interval; below 0 inside.
double distanceTo(const Interval<double> &interval, double value) {
  return std::max(interval.low ? *interval.low - value : kNoDepth, interval.high ? value - *interval.high : kNoDepth);
}
bool isEmpty(const Interval<double> &interval) {
  return interval.low && interval.high && *interval.low >= *interval.high;
}
/// The number of [a, b] that is deepest inside of an interval.
double deepest(const Interval<double> &interval, double a, double b) {
  const auto [low, high] = std::minmax(a, b);
  if (interval.low && interval.high)
    return std::clamp((*interval.low + *interval.high) / 2, low, high);
  return interval.high ? low : high;
}

/// From what lies apart in two directions at right angles; below 0: the way out.
double separation(double a, double b) { return a > 0 && b > 0 ? std::hypot(a, b) : std::max(a, b); }

double above(double value) { return std::max(0.0, value); }

double distanceTo(const Box<double> &box, double x, double y) {
  return separation(distanceTo(box.sides[0], x), distanceTo(box.sides[1], y));
}

/// A lying cylinder, seen along its axis: the distance across of a point, and the axis that its length is measured in.
struct Lying {
  std::size_t along;
  std::size_t across; // X or Y
};
std::optional<Lying> lying(const Cylinder<double> &cylinder) {
  if (cylinder.axis == Axis::Z)
    return std::nullopt;
  return cylinder.axis == Axis::X ? Lying{0, 1} : Lying{1, 0};
}

// ---- keeping in ----

/// Keeping in: a tool is the sum of a ball of its corner radius and an upright column on that.  The formula of each
/// shape asks how far from its middle the outermost point of this sum is.
class KeptIn {
public:
  KeptIn(const Tool<double> &tool, const Point<double> &point) : tool_(tool), point_(point) {}

  double depth(const Box<double> &box) const {
    return std::max({distanceTo(box.sides[0], point_[0]) + tool_.radius,
                     distanceTo(box.sides[1], point_[1]) + tool_.radius, distanceTo(box.sides[2], point_[2])});
  }
  double depth(const Cylinder<double> &cylinder) const {
    const auto flat = lying(cylinder);
    if (!flat) {
      const double distance = std::hypot(point_[0] - cylinder.centre[0], point_[1] - cylinder.centre[1]);
      return std::max(distance + tool_.radius - cylinder.radius, distanceTo(cylinder.along, point_[2]));
    }
    const double reach = round(std::abs(point_[flat->across] - cylinder.centre[0]), cylinder.centre[1]);
    const double here = std::hypot(point_[flat->across] - cylinder.centre[0], point_[2] - cylinder.centre[1]);
    return std::max({reach - cylinder.radius, here - cylinder.radius,
                     distanceTo(cylinder.along, point_[flat->along]) + tool_.radius});
  }
  double depth(const Sphere<double> &sphere) const {
    const double across = std::hypot(point_[0] - sphere.centre[0], point_[1] - sphere.centre[1]);
    const double here = std::hypot(across, point_[2] - sphere.centre[2]);
    return std::max(round(across, sphere.centre[2]), here) - sphere.radius;
  }
  double depth(const Prism<double> &prism) const {
    return std::max(distanceTo(prism, point_[0], point_[1]) + tool_.radius, distanceTo(prism.height, point_[2]));
  }

private:
  /// How far the tool reaches from the middle of something round, whose middle is `across` from the tool's axis.
  double round(double across, double level) const {
    return std::hypot(across + tool_.radius - tool_.corner, above(level - point_[2] - tool_.corner)) + tool_.corner;
  }
  const Tool<double> &tool_;
  const Point<double> &point_;
};

double distanceBelow(const Interval<double> &interval, double value) {
  return interval.low ? *interval.low - value : kNoDepth;
}

double below(const Box<double> &box, const Point<double> &point) {
  return std::max(
      {distanceTo(box.sides[0], point[0]), distanceTo(box.sides[1], point[1]), distanceBelow(box.sides[2], point[2])});
}
double below(const Cylinder<double> &cylinder, const Point<double> &point) {
  const auto flat = lying(cylinder);
  if (!flat)
    return std::max(std::hypot(point[0] - cylinder.centre[0], point[1] - cylinder.centre[1]) - cylinder.radius,
                    distanceBelow(cylinder.along, point[2]));
  const double round = std::hypot(point[flat->across] - cylinder.centre[0], above(cylinder.centre[1] - point[2]));
  return std::max(round - cylinder.radius, distanceTo(cylinder.along, point[flat->along]));
}
double below(const Sphere<double> &sphere, const Point<double> &point) {
  const double across = std::hypot(point[0] - sphere.centre[0], point[1] - sphere.centre[1]);
  return std::hypot(across, above(sphere.centre[2] - point[2])) - sphere.radius;
}
double below(const Prism<double> &prism, const Point<double> &point) {
  return std::max(distanceTo(prism, point[0], point[1]), distanceBelow(prism.height, point[2]));
}

// ---- keeping out ----

/// How far the column of the tool, without the ball, is from the shape.
class KeptOut {
public:
  KeptOut(const Tool<double> &tool, const Point<double> &point)
      : column_(tool.radius - tool.corner), corner_(tool.corner), bottom_(point[2] + tool.corner), point_(point) {}

  double depth(const Box<double> &box) const {
    if (std::any_of(box.sides.begin(), box.sides.end(), isEmpty))
      return kNoDepth;
    return corner_ - upright(distanceTo(box, point_[0], point_[1]), box.sides[2]);
  }
  double depth(const Prism<double> &prism) const {
    if (isEmpty(prism.height))
      return kNoDepth;
    return corner_ - upright(distanceTo(prism, point_[0], point_[1]), prism.height);
  }
  double depth(const Sphere<double> &sphere) const {
    if (sphere.radius <= 0)
      return kNoDepth;
    const double across = std::hypot(point_[0] - sphere.centre[0], point_[1] - sphere.centre[1]);
    return corner_ + sphere.radius - separation(across - column_, bottom_ - sphere.centre[2]);
  }
  double depth(const Cylinder<double> &cylinder) const {
    if (cylinder.radius <= 0 || isEmpty(cylinder.along))
      return kNoDepth;
    const auto flat = lying(cylinder);
    if (!flat) {
      const double across = std::hypot(point_[0] - cylinder.centre[0], point_[1] - cylinder.centre[1]);
      return corner_ - upright(across - cylinder.radius, cylinder.along);
    }
    const double beyond = distanceTo(cylinder.along, point_[flat->along]);
    const double across = point_[flat->across] - cylinder.centre[0];
    if (beyond > 0)
      return corner_ - besideEnd(cylinder, beyond, across);
    const double middle = separation(std::abs(across) - column_, bottom_ - cylinder.centre[1]);
    return corner_ - std::max(middle - cylinder.radius, beyond - column_);
  }

private:
  double upright(double across, const Interval<double> &height) const {
    return separation(across - column_, height.high ? bottom_ - *height.high : kNoDepth);
  }
  /// From the flat end of a lying cylinder.  The nearest point of its end is found by search across it: the distance
  /// falls up to there and rises behind it, as both are convex.
  double besideEnd(const Cylinder<double> &cylinder, double beyond, double across) const {
    const auto at = [&](double y) {
      const double top = cylinder.centre[1] + std::sqrt(above(cylinder.radius * cylinder.radius - y * y));
      return separation(std::hypot(beyond, y - across) - column_, bottom_ - top);
    };
    double low = -cylinder.radius;
    double high = cylinder.radius;
    for (int i = 0; i < 80; ++i) {
      const double third = (high - low) / 3;
      if (at(low + third) < at(high - third))
        high -= third;
      else
        low += third;
    }
    return at((low + high) / 2);
  }

  double column_, corner_, bottom_;
  const Point<double> &point_;
};

} // namespace

double distanceTo(const Prism<double> &prism, double x, double y) {
  double square = std::numeric_limits<double>::infinity();
  bool isInside = false;
  for (std::size_t i = 0, j = prism.corners.size() - 1; i < prism.corners.size(); j = i++) {
    const auto [ax, ay] = prism.corners[j];
    const auto [bx, by] = prism.corners[i];
    const double dx = bx - ax;
    const double dy = by - ay;
    const double length = dx * dx + dy * dy;
    const double share = length == 0 ? 0 : std::clamp(((x - ax) * dx + (y - ay) * dy) / length, 0.0, 1.0);
    const double ex = ax + share * dx - x;
    const double ey = ay + share * dy - y;
    square = std::min(square, ex * ex + ey * ey);
    if ((ay > y) != (by > y) && x < ax + (y - ay) * dx / dy)
      isInside = !isInside;
  }
  return isInside ? -std::sqrt(square) : std::sqrt(square);
}

double depthOutside(const Box<double> &box, const Point<double> &point) {
  return std::max(
      {distanceTo(box.sides[0], point[0]), distanceTo(box.sides[1], point[1]), distanceTo(box.sides[2], point[2])});
}

double depthOutside(const PlainShape &part, const Tool<double> &tool, const Point<double> &point) {
  const KeptIn kept(tool, point);
  return match(
      part,
      [&](const Condition<double, bool> &) {
        return sampledOutside({&part, 1}, tool, point);
      },
      [&](const auto &shape) { return kept.depth(shape); });
}

double depthBelow(const PlainShape &part, const Point<double> &point) {
  return match(
      part, [&](const Condition<double, bool> &condition) { return holdsBelow(condition, point) ? 0.0 : 1.0; },
      [&](const auto &shape) { return below(shape, point); });
}

double depthInside(const PlainShape &part, const Tool<double> &tool, const Point<double> &point) {
  const KeptOut kept(tool, point);
  return match(
      part, [&](const Condition<double, bool> &condition) { return sampledInside(condition, tool, point); },
      [&](const auto &shape) { return kept.depth(shape); });
}

std::optional<std::array<double, 2>> deepestInRectangle(const PlainShape &part, const Point<double> &a,
                                                        const Point<double> &b) {
  using Place = std::optional<std::array<double, 2>>;
  const auto nearest = [&](std::size_t axis, double value) { return deepest({value, value}, a[axis], b[axis]); };
  return match(
      part,
      [&](const Box<double> &box) {
        return Place({deepest(box.sides[0], a[0], b[0]), deepest(box.sides[1], a[1], b[1])});
      },
      [&](const Cylinder<double> &cylinder) {
        const auto flat = lying(cylinder);
        if (!flat)
          return Place({nearest(0, cylinder.centre[0]), nearest(1, cylinder.centre[1])});
        std::array<double, 2> place{};
        place[flat->across] = nearest(flat->across, cylinder.centre[0]);
        place[flat->along] = deepest(cylinder.along, a[flat->along], b[flat->along]);
        return Place(place);
      },
      [&](const Sphere<double> &sphere) {
        return Place({nearest(0, sphere.centre[0]), nearest(1, sphere.centre[1])});
      },
      [](const Prism<double> &) { return Place(); }, [](const Condition<double, bool> &) { return Place(); });
}

bool isConvex(const PlainShape &part) { return !std::holds_alternative<Prism<double>>(part) && hasDistances(part); }

bool hasDistances(const PlainShape &part) { return !std::holds_alternative<Condition<double, bool>>(part); }

} // namespace feedhold::geometry
