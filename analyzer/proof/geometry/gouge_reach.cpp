#include "proof/geometry/gouge_reach.h"

#include <algorithm>
#include <cmath>

namespace feedhold::geometry {

namespace {

/// Along the axes, and between X and Y.
const std::array<Point<double>, 10> &directions() {
  static const double kHalf = std::sqrt(0.5);
  static const std::array<Point<double>, 10> all{{{1, 0, 0},
                                                  {-1, 0, 0},
                                                  {0, 1, 0},
                                                  {0, -1, 0},
                                                  {0, 0, 1},
                                                  {0, 0, -1},
                                                  {kHalf, kHalf, 0},
                                                  {-kHalf, kHalf, 0},
                                                  {kHalf, -kHalf, 0},
                                                  {-kHalf, -kHalf, 0}}};
  return all;
}

Point<double> moved(const Point<double> &point, const Point<double> &direction, double distance) {
  return {point[0] + distance * direction[0], point[1] + distance * direction[1], point[2] + distance * direction[2]};
}

} // namespace

double ToolReach::outside(const PlainRegion &region, const Point<double> &point) const {
  const double there = depthOutside(region, tool_, point);
  if (beside_ == 0)
    return there;
  // The depth is a distance to the border, along which the tool comes so much further.
  if (region.parts.size() == 1 && hasDistances(region.parts.front()))
    return there + beside_;
  double worst = there;
  for (const Point<double> &direction : directions())
    worst = std::max(worst, depthOutside(region, tool_, moved(point, direction, beside_)));
  return worst;
}

/// All places together are a larger tool, whose point is lower.
double ToolReach::inside(const PlainShape &part, const Point<double> &point) const {
  return depthInside(part, {tool_.radius + beside_, tool_.corner + beside_}, moved(point, {0, 0, -1}, beside_));
}

} // namespace feedhold::geometry
