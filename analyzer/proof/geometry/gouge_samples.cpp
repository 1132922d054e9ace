#include "proof/geometry/gouge_samples.h"

#include "base/support/match.h"
#include "proof/geometry/gouge_depth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace feedhold::geometry {

namespace {

constexpr std::size_t kAngles = 64;
constexpr std::size_t kFewAngles = kAngles / 4; // of conditions, which are slow to read

/// Distances from the nearest that counts to the largest that a machine travels, each double the last.
constexpr double kShortest = 1e-8;
constexpr double kLongest = 1e4;

const std::array<std::array<double, 2>, kAngles> &circle() {
  static const auto points = [] {
    std::array<std::array<double, 2>, kAngles> made;
    for (std::size_t i = 0; i < kAngles; ++i) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(i) / kAngles;
      made[i] = {std::cos(angle), std::sin(angle)};
    }
    return made;
  }();
  return points;
}

/// A circle on the cutting end; what is above it is tool.
struct Ring {
  double radius;
  double height; // above the tip
};
/// From the rim of the shank to the middle.
std::vector<Ring> ringsOf(const Tool<double> &tool) {
  const double flat = tool.radius - tool.corner;
  const auto onCorner = [&](double angle) {
    return Ring{flat + tool.corner * std::sin(angle), tool.corner * (1 - std::cos(angle))};
  };
  constexpr double kRight = std::numbers::pi / 2;
  std::vector<Ring> rings = {onCorner(kRight)};
  if (tool.corner > 0)
    rings.insert(rings.end(), {onCorner(kRight * 2 / 3), onCorner(kRight / 3), onCorner(0)});
  if (flat > 0)
    rings.push_back({flat / 2, 0});
  return rings;
}

Point<double> pointAt(const Ring &ring, std::size_t angle, const Point<double> &tip) {
  const auto [x, y] = circle()[angle];
  return {tip[0] + ring.radius * x, tip[1] + ring.radius * y, tip[2] + ring.height};
}

Point<double> between(const Point<double> &a, const Point<double> &b, double share) {
  return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])};
}
double distance(const Point<double> &a, const Point<double> &b) {
  return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

/// How far from b, on the straight way to a, the first point is where `holds`, as it does at a.
template <typename Holds> double distanceTo(const Holds &holds, const Point<double> &a, const Point<double> &b) {
  double good = 0;
  double bad = 1;
  for (int i = 0; i < 30; ++i) {
    const double middle = (good + bad) / 2;
    (holds(between(a, b, middle)) ? good : bad) = middle;
  }
  return (1 - good) * distance(a, b);
}

std::array<Point<double>, 6> around(const Point<double> &point, double reach) {
  std::array<Point<double>, 6> points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = point;
    points[i][i / 2] += i % 2 == 0 ? -reach : reach;
  }
  return points;
}

template <typename Holds> bool hasNear(const Holds &holds, const Point<double> &point, double reach) {
  const auto points = around(point, reach);
  return std::any_of(points.begin(), points.end(), holds);
}

/// How far the nearest point is where `holds`, along the axes.
template <typename Holds> double nearest(const Holds &holds, const Point<double> &point) {
  for (double reach = kShortest; reach < kLongest; reach *= 2) {
    double least = kLongest;
    for (const Point<double> &there : around(point, reach))
      if (holds(there))
        least = std::min(least, distanceTo(holds, there, point));
    if (least < kLongest)
      return least;
  }
  return kLongest;
}

bool isIn(const PlainShape &part, const Point<double> &point) {
  return match(
      part, [&](const Condition<double, bool> &condition) { return condition.holds(point); },
      [&](const auto &) {
        return depthOutside(part, {0, 0}, point) <= 0;
      });
}

double outsideOfConditions(std::span<const PlainShape> parts, const Tool<double> &tool, const Point<double> &tip) {
  const auto isInside = [&](const Point<double> &point) {
    return std::any_of(parts.begin(), parts.end(), [&](const PlainShape &part) { return isIn(part, point); });
  };
  const auto isAbove = [&](const Point<double> &point) {
    return std::any_of(parts.begin(), parts.end(),
                       [&](const PlainShape &part) { return depthBelow(part, point) <= 0; });
  };
  if (!isInside(tip))
    return nearest(isInside, tip);
  double worst = kNoDepth;
  for (const Ring &ring : ringsOf(tool))
    for (std::size_t angle = 0; angle < kAngles; angle += kAngles / kFewAngles) {
      const Point<double> point = pointAt(ring, angle, tip);
      const Point<double> axis{tip[0], tip[1], point[2]}; // above the tip, and so it is free
      const bool isWorse = !isAbove(point) && (worst <= 0 || !isAbove(between(point, axis, worst / ring.radius)));
      if (isWorse)
        worst = std::max(worst, std::min(distanceTo(isAbove, tip, point), distanceTo(isAbove, axis, point)));
    }
  return worst;
}

} // namespace

bool holdsBelow(const Condition<double, bool> &condition, const Point<double> &point) {
  if (condition.holds(point))
    return true;
  Point<double> lower = point;
  for (double reach = 1e-3; reach < kLongest; reach *= 2) {
    lower[2] = point[2] - reach;
    if (condition.holds(lower))
      return true;
  }
  return false;
}

double sampledOutside(std::span<const PlainShape> parts, const Tool<double> &tool, const Point<double> &tip) {
  if (!std::all_of(parts.begin(), parts.end(), hasDistances))
    return outsideOfConditions(parts, tool, tip);
  const auto least = [&](const auto &depthOf) {
    double depth = std::numeric_limits<double>::infinity();
    for (const PlainShape &part : parts)
      depth = std::min(depth, depthOf(part));
    return depth;
  };
  double worst = least([&](const PlainShape &part) { return depthOutside(part, {0, 0}, tip); });
  for (const Ring &ring : ringsOf(tool))
    for (std::size_t angle = 0; angle < kAngles; ++angle) {
      const Point<double> point = pointAt(ring, angle, tip);
      worst = std::max(worst, least([&](const PlainShape &part) { return depthBelow(part, point); }));
    }
  return worst;
}

double sampledInside(const Condition<double, bool> &condition, const Tool<double> &tool, const Point<double> &tip) {
  const auto isFree = [&](const Point<double> &point) { return !condition.holds(point); };
  double worst = kNoDepth;
  const auto tryAt = [&](const Point<double> &point) {
    if (isFree(point) || (worst > 0 && hasNear(isFree, point, worst)))
      return;
    worst = std::max(worst, nearest(isFree, point));
  };
  const double step = std::max(tool.radius, 1e-2) / 4;
  std::vector<Ring> rings = ringsOf(tool);
  rings.push_back({0, 0});
  for (const Ring &ring : rings)
    for (std::size_t angle = 0; angle < (ring.radius > 0 ? kAngles : 1); angle += kAngles / kFewAngles)
      for (double rise = 0; rise < 300 * step; rise = rise * 3 + step) { // up the shank
        Point<double> point = pointAt(ring, angle, tip);
        point[2] += rise;
        tryAt(point);
      }
  return worst;
}

double depthOutside(const PlainRegion &region, const Tool<double> &tool, const Point<double> &point) {
  double depth = std::numeric_limits<double>::infinity();
  for (const PlainShape &part : region.parts)
    depth = std::min(depth, depthOutside(part, tool, point));
  return depth <= 0 || region.parts.size() == 1 ? depth : sampledOutside(region.parts, tool, point);
}

} // namespace feedhold::geometry
