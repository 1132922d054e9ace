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

/// Straight lines, arcs and F: nothing that computes, calls, may be skipped, or changes a mode but that of motion.
bool isPlainContour(const SyntaxTree &tree, const ProgramModel &model, const Dialect &dialect,
                    const ContourBlocks &contour);

} // namespace feedhold
