// GougeSamples: depths by trying points of the tool, where there is no formula.  Internal to geometry/.
#pragma once

#include "proof/geometry/gouge.h"

namespace feedhold::geometry {

/// Whether a condition holds at a point or at one below it.
bool holdsBelow(const Condition<double, bool> &condition, const Point<double> &point);

double sampledOutside(std::span<const PlainShape> parts, const Tool<double> &tool, const Point<double> &point);
double sampledInside(const Condition<double, bool> &condition, const Tool<double> &tool, const Point<double> &point);

} // namespace feedhold::geometry
