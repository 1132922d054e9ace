// Tool path: the points that a movement may lead through, over terms.
#pragma once

#include "meaning/semantics/moves.h"
#include "proof/geometry/free_space.h"

namespace feedhold::geometry {

/// An arc of less than half a circle, or of more.
enum class ArcLength : std::uint8_t { Short, Long };
/// Of an arc that is given by R in place of its centre.
struct ArcRadius {
  TermId size; // above 0
  ArcLength length;
};

/// In the space of the start (shapes.h); a move whose path is known.
struct TermMove {
  MoveKind kind;
  TermPoint start;
  TermPoint end;
  bool isInBox;           // anywhere in the box between its ends (moves.h)
  Plane plane = kPlaneXY; // of an arc
  TermId firstCentre = TermId(0);
  TermId secondCentre = TermId(0);
  std::uint32_t turns = 1;
  std::optional<ArcRadius> radius = {};
};

/// Any point on the path: new variables, which `conditions` keep on the path.
struct PointOnPath {
  TermPoint point;
  std::vector<TermId> conditions;
};

class ToolPath {
public:
  ToolPath(TermStore &store, TermMove move);

  /// Of an arc by R with its centre, where the form of its terms tells it.
  const TermMove &move() const { return move_; }
  /// Points whose convex hull contains all of the path.  `conditions` of their variables.
  struct Hull {
    std::vector<TermPoint> corners;
    std::vector<TermId> conditions;
    std::vector<std::pair<TermId, TermId>> example = {}; // values that the conditions allow, by variable
  };
  Hull hull();
  /// Rapid moves that are not interpolated: anywhere in the box between the ends, as axes that are positioned each by
  /// itself go, at whatever rates; strokes in a box likewise.  What lies between the ends of a helix along its axis is
  /// taken at any turn.
  PointOnPath anyPoint();
  /// The hull is the path itself: a convex set has the one if it has the other.
  bool isHull() const { return !isArc(); }
  /// X and Y stay as they are.
  bool isVertical() const { return !isArc() && move_.start[0] == move_.end[0] && move_.start[1] == move_.end[1]; }
  /// An arc about an upright axis, whose centre is known.
  bool isUprightArc() const { return isArc() && !move_.radius && move_.plane.normal == Axis::Z; }
  /// The quarter arcs that it may be; empty: none.
  std::vector<QuarterArc> quarters() const;
  /// Of an arc: the same level, at its centre.
  TermPoint atCentre(TermPoint point) const;

private:
  bool isArc() const { return feedhold::isArc(move_.kind); }
  bool isBox() const { return move_.isInBox; }
  Hull boxHull() const;
  Hull arcHull();
  PointOnPath pointOfLine();
  PointOnPath pointOfBox();
  PointOnPath pointOfArc();
  PointOnPath pointOfArcByRadius();
  bool findCentre();
  bool centreIsLeft() const;
  TermId share(PointOnPath &onPath);
  TermId between(PointOnPath &onPath, TermId start, TermId end);
  TermId sector(TermId x, TermId y) const;
  TermId besideChord(TermId x, TermId y) const;

  /// From the centre to the ends, in the plane.
  struct Spokes {
    TermId startFirst, startSecond, endFirst, endSecond;
  };
  Spokes spokes() const;
  TermId square(TermId first, TermId second) const;

  TermStore &store_;
  TermMove move_;
};

} // namespace feedhold::geometry
