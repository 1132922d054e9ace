// The radii of an arc with I, J, K at its two ends, where the analysis does not know the points: as sums of multiples
// of what the variables hold, which often has no part in the difference.
#pragma once

#include "inference/domain/interval.h"
#include "rules/motion/motion_view.h"

#include <array>
#include <optional>

namespace feedhold::rules {

/// What is in force in the block of an arc.
struct ArcBlock {
  Plane plane;
  bool isAbsolute; // G90 in the block
  bool isInch;
  std::optional<bool> wasAbsolute;                 // before the block; absent: not known
  std::array<std::optional<double>, 2> start = {}; // coordinates in the plane, where they are known
  friend bool operator==(const ArcBlock &left, const ArcBlock &right) {
    return left.plane.normal == right.plane.normal && left.isAbsolute == right.isAbsolute &&
           left.isInch == right.isInch && left.wasAbsolute == right.wasAbsolute && left.start == right.start;
  }
};

/// Both lie further apart than the control tolerates, whatever the variables hold.
struct ApartRadii {
  Interval start;
  Interval end;
  bool dependsOnVariables; // some word of the arc has an expression
  /// The end lies this far from the start on the line through the centre: the radii agree for one value only, that of a
  /// half circle.
  std::optional<double> shift = std::nullopt;
};

/// Absent: the radii may be equal, or it cannot be told.  A word whose variable is vacant counts as written: the claim
/// is about numbers.
std::optional<ApartRadii> apartRadii(const MotionView &view, const FlowFacts &facts, NodeId arc, const ArcBlock &block);

} // namespace feedhold::rules
