// HalfPlane: the space of a lathe.
//
// The part turns, so that what matters of a point is its Z and its distance from the axis of the spindle, and the tool
// is the disc of its nose.  This plane is laid into that of shapes.h: Z of the lathe is the first coordinate there, the
// radius the second, and the nose a flat tool that stands upright on it.  Regions have no ends in the third direction.
// Arcs keep their direction: G18 turns from Z to X.
#pragma once

#include "meaning/machine/machine.h"
#include "proof/geometry/shapes.h"

namespace feedhold::geometry {

/// Where the programmed point lies from the centre of the nose, in radii along X and Z: -1, 0 or 1.
struct TipDirection {
  int x;
  int z;
};
/// Of the number that controls give it (X up, Z to the right; docs/geometry.md); 0: the centre itself.
TipDirection tipDirection(std::uint8_t number);

/// A move of the programmed point, as one of the centre of a nose of this radius.  Whatever leads out of the plane is
/// not of the tool.
RecordedMove inHalfPlane(RecordedMove recorded, const TipDirection &direction, double radius);
/// Where the centre of the nose is, if the programmed point is here: X as a diameter, Y, Z.
Point<double> toHalfPlane(const Point<double> &programmed, const TipDirection &direction, double radius);
/// X as a diameter, Y, Z of the programmed point, where the centre of the nose is here.
Point<double> fromHalfPlane(const Point<double> &centre, const TipDirection &direction, double radius);

} // namespace feedhold::geometry
