// Contours: the blocks that a cycle of a lathe reads (G70 to G73).
#pragma once

#include "language/dialect/dialect.h"
#include "language/model/model.h"

namespace feedhold {

struct ContourBlocks {
  BlockId first; // P of the cycle
  BlockId last;  // Q, not before P
};
/// Absent where P or Q is missing, or names no block.
std::optional<ContourBlocks> contourAt(const ProgramModel &model, BlockId cycle);
/// P and Q each stand in one block of the program only.
bool isContourUnambiguous(const ProgramModel &model, BlockId cycle);

/// The codes that a contour has beside its path.
enum class ContourCodes : std::uint8_t { OfPath, OfCompensation };
/// Straight lines, arcs and F, perhaps with G40 to G42: nothing that computes, calls, may be skipped, or changes
/// another mode.
bool isPlainContour(const SyntaxTree &tree, const ProgramModel &model, const Dialect &dialect,
                    const ContourBlocks &contour, ContourCodes codes = ContourCodes::OfPath);

} // namespace feedhold
