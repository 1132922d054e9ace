// Quarter arcs: arcs that turn from near one of the directions along X and Y to near the next one, and what lies behind
// them, told without products of coordinates.
//
// Seen from the centre, let u be the coordinate in the direction of the start and v the one in that of the end, with
// |uEnd| < uStart and |vStart| < vEnd.  Then the cross product of both ends, uStart vEnd - uEnd vStart, is above 0: the
// arc is the shorter way between them.  It leads through the quadrant u >= 0, v >= 0, and leaves it only at an end with
// vStart < 0 or uEnd < 0.
//
// How near does it come to the opposite quadrant, u <= 0 and v <= 0?  A point p with u, v >= 0 is at least |p| away,
// and that is no less than the nearer end: than uStart or than vEnd.  A point with vStart <= v < 0 is at least u away.
// On a circle u >= uStart there.  If the radii of the ends differ, all between them are taken, and u >= vEnd uStart /
// |start| >= vEnd (1 - |vStart| / uStart), which with vEnd <= 2 uStart is no less than vEnd - 2 |vStart|; likewise at
// the other end.  These lower bounds are `distances`.
//
// A point is max(0, u) + max(0, v) away from that quadrant at most, which is a convex function: a polygon is as near as
// its furthest corner.  Where that and the radius of the tool are together no more than each of `distances`, the tool
// keeps out of it.
#pragma once

#include "proof/geometry/shapes.h"
#include "proof/smt/term.h"

#include <array>
#include <optional>
#include <vector>

namespace feedhold::geometry {

/// Towards X (0) or Y (1), upwards or downwards.
struct Direction {
  std::size_t axis;
  bool isUp;
};

struct QuarterArc {
  std::array<smt::TermId, 2> centre;   // X, Y
  std::array<Direction, 2> directions; // of the start and of the end, as seen from the centre
  std::vector<smt::TermId> distances;  // of the opposite quadrant: each point of the arc is as far away as the least
  smt::TermId isOne;                   // it is such an arc
};

/// An arc about an upright axis, which makes no full turn.
struct UprightArc {
  std::array<smt::TermId, 2> centre, start, end; // X, Y
  bool isCounterclockwise;
};

/// What it may be: each arc of `isOne` that is not known to be none.
std::vector<QuarterArc> quarterArcs(smt::TermStore &store, const UprightArc &arc);

/// A tool of this radius, anywhere on the arc and at any level, keeps out of the shape, which lies behind the arc.
/// Absent: of a shape that is not looked at.
std::optional<smt::TermId> keepsOutBehind(smt::TermStore &store, const QuarterArc &arc, smt::TermId toolRadius,
                                          const Shape<smt::TermId, smt::TermId> &shape);

} // namespace feedhold::geometry
