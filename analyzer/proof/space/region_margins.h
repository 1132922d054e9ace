// Regions that are a little smaller or larger: for the distance that a tool keeps, and for the tolerance within which a
// claim is meant (docs/geometry.md).
#pragma once

#include "proof/geometry/free_space.h"

#include <optional>
#include <vector>

namespace feedhold::prove {

/// What is so far from the border, or further; of a polygon only its height becomes less.  A condition stays as it is.
geometry::TermShape shrunk(smt::TermStore &store, const geometry::TermShape &part, smt::TermId margin);

struct TolerantRegion {
  geometry::Tool<smt::TermId> tool;
  std::vector<geometry::TermShape> parts;
};

/// Where a tool that keeps in the parts may be if each side of these may be passed by the tolerance.  The sides of
/// a condition, and of a polygon among other shapes or for a tool that is not flat, stay where they are.
TolerantRegion keptInWithin(smt::TermStore &store, const geometry::Tool<smt::TermId> &tool,
                            const std::vector<geometry::TermShape> &parts, smt::TermId tolerance);

/// The points of a tool that are so deep in it: where these keep out of a region, no part of the tool is deeper in the
/// region.  Its point is higher by as much.  Of a flat or a ball tool; absent: of another.
std::optional<geometry::Tool<smt::TermId>> eroded(smt::TermStore &store, const geometry::Tool<smt::TermId> &tool,
                                                  smt::TermId tolerance);

} // namespace feedhold::prove
