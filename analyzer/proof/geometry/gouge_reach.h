// GougeReach: how deep a tool is wrong that may be beside its path (docs/soundness-motion.md, corners).
#pragma once

#include "proof/geometry/gouge_depth.h"

namespace feedhold::geometry {

/// Wherever the tool is while its point is no further from the one asked than `beside`.
class ToolReach {
public:
  ToolReach(const Tool<double> &tool, double beside) : tool_(tool), beside_(beside) {}

  const Tool<double> &tool() const { return tool_; }
  double beside() const { return beside_; }
  /// As depthOutside() and depthInside() of gouge_depth.h, of the deepest of these places.  Of a region with several
  /// parts, or with a condition, places are tried.
  double outside(const PlainRegion &region, const Point<double> &point) const;
  double inside(const PlainShape &part, const Point<double> &point) const;

private:
  Tool<double> tool_;
  double beside_;
};

} // namespace feedhold::geometry
