// GougeDepth: how deep a tool is wrong at one point.
//
// A depth above 0 is a violation; one below 0 is what is kept.  Where the tool moves by some length, the depth changes
// by no more than that, except with a Condition, which knows no distances: free of violation it is kNoDepth.
#pragma once

#include "proof/geometry/gouge.h"

#include <limits>

namespace feedhold::geometry {

inline constexpr double kNoDepth = -std::numeric_limits<double>::infinity();

/// Of the point alone.
double depthOutside(const Box<double> &box, const Point<double> &point);
/// To keep in: by how much the point is outside of the region, or the tool outside of it and all that lies above it.
double depthOutside(const PlainShape &part, const Tool<double> &tool, const Point<double> &point);
/// Parts taken together: the tool may be half in one and half in another.  Points of its cutting end are tried.
double depthOutside(const PlainRegion &region, const Tool<double> &tool, const Point<double> &point);
/// By how much a point is outside of a part and all that lies above it; of a Condition 0 where it is.
double depthBelow(const PlainShape &part, const Point<double> &point);
/// To keep out: by how much the tool is in the interior.
double depthInside(const PlainShape &part, const Tool<double> &tool, const Point<double> &point);

/// The X Y of a rectangle where the tool is deepest inside of a part, at any one Z; absent where no formula tells.
std::optional<std::array<double, 2>> deepestInRectangle(const PlainShape &part, const Point<double> &a,
                                                        const Point<double> &b);

bool isConvex(const PlainShape &part); // and known to be
bool hasDistances(const PlainShape &part);

/// Distance of a point to the border of an upright region in X Y, below 0 inside.
double distanceTo(const Prism<double> &prism, double x, double y);

} // namespace feedhold::geometry
