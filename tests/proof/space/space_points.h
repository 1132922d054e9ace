// Space points: gouges by trying points of the tool at points of its way, with formulas of their own.  Shallow ones are
// missed; what is found is one.
#pragma once

#include "proof/geometry/gouge.h"
#include "soundness/macro_programs.h"

#include <optional>
#include <span>

namespace feedhold::proof_tests {

using SpacePoint = geometry::Point<double>;

/// A point of the tool that is wrong by more than `depth` while its tip is at `tip`.
std::optional<SpacePoint> wrongPoint(const geometry::PlainSpace &space, geometry::SpaceClaim claim, std::size_t region,
                                     const SpacePoint &tip, double depth, soundness::Random &random);

struct SeenGouge {
  std::size_t move;
  SpacePoint tip;
  SpacePoint point; // of the tool
};
/// In the moves of one block.
std::optional<SeenGouge> seenGouge(const geometry::PlainSpace &space, geometry::SpaceClaim claim, std::size_t region,
                                   std::span<const RecordedMove> moves, Place own, double depth,
                                   soundness::Random &random);

/// Where the tool may be, up to PlainSpace::corner beside a place on its path.
SpacePoint anyBeside(const geometry::PlainSpace &space, geometry::SpaceClaim claim, SpacePoint tip,
                     soundness::Random &random);

/// Of the tool as shapes see it, where the programmed point is here.
SpacePoint toolAt(const geometry::PlainSpace &space, geometry::SpaceClaim claim, const SpacePoint &programmed);

/// Where the tip is: lines and arcs as the manual draws them, rapid moves anywhere between their ends.
SpacePoint anyTip(const RecordedMove &recorded, soundness::Random &random);

} // namespace feedhold::proof_tests
