// GougePath: a recorded move as a curve in the space of the start.
#pragma once

#include "proof/geometry/gouge.h"

namespace feedhold::geometry {

class GougePath {
public:
  explicit GougePath(const RecordedMove &recorded);

  bool isStraight() const { return !arc_; }
  /// Angle of an arc, above 0 from the first axis of its plane to the second; of a line 0.
  double sweep() const { return arc_ ? arc_->sweep : 0; }
  /// Of the whole curve, or a little more.
  double length() const { return length_; }
  /// Full circles, the last perhaps not full; of a line 1.
  std::size_t rounds() const;
  Point<double> at(double share) const;
  /// Where a coordinate can be largest or smallest: the ends, and where an arc is parallel to an axis.
  std::vector<double> extremes() const;

  const Point<double> &start() const { return start_; }
  const Point<double> &end() const { return end_; }

private:
  struct Arc {
    std::size_t first, second; // axes of its plane
    std::array<double, 2> centre;
    double startAngle;
    double sweep; // above 0: from the first axis to the second
    double startRadius, endRadius;
  };
  void bend(const RecordedMove &recorded);

  Point<double> start_, end_;
  std::optional<Arc> arc_;
  double length_;
};

} // namespace feedhold::geometry
