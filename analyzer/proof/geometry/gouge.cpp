#include "proof/geometry/gouge.h"

namespace feedhold::geometry {

Point<double> pointOf(const RecordedMove &recorded, double share) {
  Point<double> point;
  for (std::size_t i = 0; i < 3; ++i) {
    const double start = recorded.move.start[i].number;
    point[i] = start + share * (recorded.move.end[i].number - start) + recorded.zero[i];
  }
  return point;
}

} // namespace feedhold::geometry
