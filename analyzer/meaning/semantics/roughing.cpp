#include "meaning/semantics/roughing.h"

#include <cmath>

namespace feedhold {

namespace {

constexpr double kSame = 1e-9;
constexpr double kMostCuts = 9999;

/// Both ends lie in one quadrant about the centre.
bool isWithinQuadrant(const RoughingPiece &piece) {
  if (!piece.centre)
    return true;
  const auto agree = [](double a, double b) { return a * b >= -kSame; };
  return agree(piece.start.level - piece.centre->level, piece.end.level - piece.centre->level) &&
         agree(piece.start.along - piece.centre->along, piece.end.along - piece.centre->along);
}

/// Where a piece passes through a level between those of its ends.
double crossing(const RoughingPiece &piece, double level) {
  if (!piece.centre) {
    const double share = (level - piece.start.level) / (piece.end.level - piece.start.level);
    return piece.start.along + share * (piece.end.along - piece.start.along);
  }
  const double radius = std::hypot(piece.start.level - piece.centre->level, piece.start.along - piece.centre->along);
  const double beside = level - piece.centre->level;
  const double distance = std::sqrt(std::max(0.0, radius * radius - beside * beside));
  const double middle = (piece.start.along + piece.end.along) / 2;
  return piece.centre->along + (middle < piece.centre->along ? -distance : distance);
}

} // namespace

std::optional<std::vector<RoughingPoint>> roughingCuts(const Roughing &roughing) {
  if (roughing.contour.empty() || !(roughing.depth > 0))
    return std::nullopt;
  const RoughingPoint &bottom = roughing.contour.front().start, &last = roughing.contour.back().end;
  const double up = roughing.start.level < bottom.level ? -1 : 1;
  const double onwards = last.along < roughing.start.along ? -1 : 1;
  for (const RoughingPiece &piece : roughing.contour)
    if (up * (piece.end.level - piece.start.level) < -kSame ||
        onwards * (piece.end.along - piece.start.along) < -kSame || !isWithinQuadrant(piece))
      return std::nullopt;
  const double whole = up * (roughing.start.level - bottom.level);
  if (!(whole / roughing.depth < kMostCuts))
    return std::nullopt;
  std::vector<RoughingPoint> cuts;
  for (double down = roughing.depth; down < whole - kSame; down += roughing.depth) {
    const double level = roughing.start.level - up * down;
    double end = bottom.along;
    for (const RoughingPiece &piece : roughing.contour) {
      const bool isBelow = up * (piece.end.level - level) <= kSame;
      end = isBelow ? piece.end.along : crossing(piece, level);
      if (!isBelow)
        break;
    }
    cuts.push_back({level, end});
  }
  return cuts;
}

} // namespace feedhold
