// Polygons over terms: where a point is against the sides of one, whichever way round its corners are written.
#pragma once

#include "proof/smt/term.h"

#include <array>
#include <utility>
#include <vector>

namespace feedhold::geometry {

/// The side on which the inside lies, seen along the sides of a convex polygon.
enum class Turn : std::uint8_t { Left, Right };

class PolygonTerms {
public:
  using TermId = smt::TermId;
  using Corner = std::array<TermId, 2>;
  using Point = std::array<TermId, 3>; // Z is not looked at

  PolygonTerms(smt::TermStore &store, std::vector<Corner> corners);

  /// False: it is known to be no convex polygon of that turn.
  bool mayTurn(Turn turn) const;
  /// False: it is known that some corner lies on the other side of this side.
  bool mayTurnAt(std::size_t side, Turn turn) const;
  bool isKnownConvex() const;
  /// The polygon is convex with that turn, and the point lies in it at least so far from every side.
  TermId deepIn(const Point &point, Turn turn, TermId distance) const;
  /// The whole polygon is on one side of the line of a side, and the point on the other, at least so far from it.
  TermId beyond(const Point &point, std::size_t side, Turn turn, TermId distance) const;
  /// By how often a line from the point crosses the sides; on a side itself either way.
  TermId contains(const Point &point) const;
  /// No point of any side is nearer.
  TermId keepsFromSides(const Point &point, TermId distance) const;
  TermId hasArea() const;
  /// No two sides have a point in common but for the corner between them: which points are inside is clear then.
  TermId isSimple() const;

private:
  const Corner &from(std::size_t side) const { return corners_[side]; }
  const Corner &to(std::size_t side) const { return corners_[(side + 1) % corners_.size()]; }
  /// Along a side; where `isOpposite` holds, against it.
  struct Way {
    TermId x;
    TermId y;
    TermId isOpposite;
  };
  Way wayOf(std::size_t side) const;
  /// And its length.
  std::pair<Way, TermId> shortWayOf(std::size_t side) const;
  TermId cross(std::size_t side, TermId x, TermId y, Turn turn) const;
  TermId across(const Way &way, std::size_t side, TermId x, TermId y, Turn turn) const;
  TermId cornersOnSide(std::size_t side, Turn turn) const;
  TermId length(std::size_t side) const;
  TermId isApart(std::size_t side, std::size_t other) const;
  TermId keepsFrom(std::size_t side, const Point &point, TermId distance) const;

  smt::TermStore &store_;
  std::vector<Corner> corners_;
};

} // namespace feedhold::geometry
