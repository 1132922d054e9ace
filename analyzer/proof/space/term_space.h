// TermSpace: how the movements of a proof lie in the space of shapes.  On a machining centre as they are; on a lathe in
// the plane of half_plane.h, where the centre of the nose stands for the tool.
#pragma once

#include "proof/explore/exploration.h"
#include "proof/geometry/half_plane.h"
#include "proof/geometry/tool_path.h"

namespace feedhold::prove {

struct LatheTip {
  TipDirection direction;
  smt::TermId radius;
};

class TermSpace {
public:
  /// `tip`: of a lathe.
  TermSpace(smt::TermStore &store, std::optional<LatheTip> tip) : store_(store), tip_(tip) {}

  bool isLathe() const { return tip_.has_value(); }
  geometry::TermPoint point(const std::array<SymbolicValue, kAxisCount> &position,
                            const std::array<SymbolicValue, 3> &zero) const;
  geometry::TermMove move(const MoveInstance &instance) const;
  /// The same for the programmed point, which `@TRAVEL` speaks of.
  TermSpace ofProgrammed() const;

private:
  smt::TermId radius(smt::TermId diameter) const;
  smt::TermId fromTip(smt::TermId coordinate, int direction) const;
  geometry::TermPoint point(smt::TermId x, smt::TermId y, smt::TermId z) const;

  smt::TermStore &store_;
  std::optional<LatheTip> tip_;
};

} // namespace feedhold::prove
