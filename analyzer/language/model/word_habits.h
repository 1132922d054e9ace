// How the words of a file are written where a setting of the machine decides what they mean: rules judge one word by
// the others, and a folder tells how its machine is set.
#pragma once

#include "language/dialect/dialect.h"
#include "language/syntax/tree.h"

#include <cstddef>
#include <vector>

namespace feedhold {

/// Coordinates and distances other than 0, by parameter 3401#0 (DPI) in mm or in least increments.
struct WrittenLengths {
  std::vector<WordId> withoutPoint;
  std::size_t withPoint = 0;
  std::size_t wholeWithPoint = 0; // `2.`, `-28.`
};
/// Arguments, data, seconds and settings of cycles do not count among those without a point.
WrittenLengths lengthsOf(const SyntaxTree &tree, const Dialect &dialect);

/// The G02 or G03 of a block with an end point and without R, I, J, K (parameter 3403#5, CIR); else null.
const Word *arcWithoutCentre(const SyntaxTree &tree, BlockId block, const Dialect &dialect);

/// The M codes that a block executes at once (parameter 3404#7, M3B).
struct WrittenMCodes {
  const Word *first = nullptr;
  const Word *last = nullptr;
  std::size_t count = 0;
};
WrittenMCodes mCodesOf(const SyntaxTree &tree, BlockId block);

} // namespace feedhold
