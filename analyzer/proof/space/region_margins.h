// Regions that are a little smaller or larger: for the distance that a tool keeps, for how far it may be from its path,
// and for the tolerance within which a claim is meant (docs/geometry.md).
#pragma once

#include "proof/geometry/free_space.h"

#include <vector>

namespace feedhold::prove {

/// What is so far from the border, or further; of a polygon only its height becomes less.  A condition stays as it is.
geometry::TermShape shrunk(smt::TermStore &store, const geometry::TermShape &part, smt::TermId margin);

/// No condition is among them.
bool knowDistances(const std::vector<geometry::TermShape> &parts);

/// Where the point of a tool may be that is to keep in the parts, and so far from their border; below 0: that may pass
/// each of their sides by so much.  It is in all of the spaces.
std::vector<geometry::FreeSpace> insideAt(smt::TermStore &store, const geometry::Tool<smt::TermId> &tool,
                                          const std::vector<geometry::TermShape> &parts, const smt::Number &distance);
/// The same of a tool that is to keep out of them.
std::vector<geometry::FreeSpace> outsideAt(smt::TermStore &store, const geometry::Tool<smt::TermId> &tool,
                                           const std::vector<geometry::TermShape> &parts, const smt::Number &distance);

} // namespace feedhold::prove
