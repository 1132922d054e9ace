// HalfPlane: the space of a lathe.
//
// The part turns, so that what matters of a point is its Z and its distance from the axis of the spindle, and the tool
// is the disc of its nose.  This plane is laid into that of shapes.h: Z of the lathe is the first coordinate there, the
// radius the second, and the nose a flat tool that stands upright on it.  Regions have no ends in the third direction.
// Arcs keep their direction: G18 turns from Z to X.
#pragma once

#include "meaning/machine/machine.h"
#include "meaning/semantics/tip_direction.h"
#include "proof/geometry/shapes.h"

namespace feedhold::geometry {

/// A move of the programmed point, as one of the centre of a nose of this radius.  Whatever leads out of the plane is
/// not of the tool.
RecordedMove inHalfPlane(RecordedMove recorded, const TipDirection &direction, double radius);
/// Where the centre of the nose is, if the programmed point is here: X as a diameter, Y, Z.
Point<double> toHalfPlane(const Point<double> &programmed, const TipDirection &direction, double radius);
/// X as a diameter, Y, Z of the programmed point, where the centre of the nose is here.
Point<double> fromHalfPlane(const Point<double> &centre, const TipDirection &direction, double radius);

} // namespace feedhold::geometry
