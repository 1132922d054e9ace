// Free space: where the point of a tool may be, as formulas over its coordinates.
//
// A region and a tool become conditions on one point: a region to keep in shrinks by the tool, one to keep out of grows
// (the configuration space of Lozano-Perez, "Spatial planning", 1983).  Each formula says no more than what is free: it
// may leave out some of it, where the exact border would be costly.
#pragma once

#include "proof/geometry/quarter_arc.h"
#include "proof/smt/term.h"

#include <string_view>

namespace feedhold::geometry {

using smt::TermId;
using smt::TermStore;
using TermShape = Shape<TermId, TermId>;
using TermPoint = Point<TermId>;
/// A formula that holds where the point may be.  Each call may make variables of its own: it has to hold for all of
/// their values.
using Formula = std::function<TermId(const TermPoint &)>;

struct FreeSpace {
  /// A convex set within it that an anchor tells: what lies beyond the plane through the anchor that faces the region.
  using Beyond = std::function<TermId(const TermPoint &anchor, const TermPoint &point)>;
  /// All points about an upright axis that are as far from it as one of the ends, or between: their levels are not
  /// looked at.
  using Around = std::function<TermId(const TermPoint &centre, const std::vector<TermPoint> &ends)>;
  /// All of the arc, at any level; absent: it cannot be told.
  using BehindQuarter = std::function<std::optional<TermId>(const QuarterArc &arc)>;

  std::vector<Formula> convexParts;  // convex sets within it: who has corners in one of them has all that lies between
  Formula all;                       // all of it that is known
  std::vector<Formula> bounds = {};  // of a convex one: convex sets that it is what they have in common
  std::vector<Beyond> beyond = {};   // of a round one to keep out of
  std::optional<Around> around = {}; // of an upright cylinder: its first bound, or all of what is free beside it
  BehindQuarter behindQuarter = {};  // of a region to keep out of that lies behind an arc; may be empty
  bool isOpenUpwards = false;        // who is in it is so, too, higher up

  bool isConvex() const { return !bounds.empty(); }
};

/// Sides in which bounds are written, for the point alone.
FreeSpace inside(TermStore &store, const Box<TermId> &box);
FreeSpace inside(TermStore &store, const Tool<TermId> &tool, const TermShape &part);
/// Parts of a region are taken one at a time: a tool that is half in one and half in another is in none.
FreeSpace inside(TermStore &store, const Tool<TermId> &tool, const std::vector<TermShape> &region);
/// In one of several spaces.
FreeSpace inOneOf(TermStore &store, std::vector<FreeSpace> spaces);
/// All that lies no further from the point than the distance is in the space.
FreeSpace deepIn(TermStore &store, FreeSpace space, TermId distance);
FreeSpace outside(TermStore &store, const Tool<TermId> &tool, const TermShape &part);

/// The tool is one, and the part of a region has an inside: without that the formulas mean nothing.
TermId isTool(TermStore &store, const Tool<TermId> &tool);
TermId isNotEmpty(TermStore &store, const TermShape &part);

/// A new variable of sort Real; its name starts with `what`.
TermId freshVariable(TermStore &store, std::string_view what);

} // namespace feedhold::geometry
