// Roughing: the cuts of G71 and G72 in plain numbers, up to a contour.
#pragma once

#include <optional>
#include <vector>

namespace feedhold {

/// `level` is the axis along which cuts are stepped: the radius for G71, Z for G72.
struct RoughingPoint {
  double level;
  double along;
};
/// A line, or an arc of no more than a quarter about `centre`.
struct RoughingPiece {
  RoughingPoint start;
  RoughingPoint end;
  std::optional<RoughingPoint> centre;
};
struct Roughing {
  RoughingPoint start;
  double depth; // of a cut
  std::vector<RoughingPiece> contour;
};

/// Where each cut ends; it begins at the start's place along.  The last one, at the level of the first piece, is left
/// to the cut along the contour.  Absent: the contour turns back along one of the axes, or the depth is not above 0.
std::optional<std::vector<RoughingPoint>> roughingCuts(const Roughing &roughing);

} // namespace feedhold
