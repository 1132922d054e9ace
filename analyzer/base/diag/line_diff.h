// Which lines differ between two texts.  Internal to diag/.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace feedhold {

/// Lines [beforeBegin, beforeEnd) of the old text are replaced by [afterBegin, afterEnd) of the new one.
struct LineChange {
  std::size_t beforeBegin = 0;
  std::size_t beforeEnd = 0;
  std::size_t afterBegin = 0;
  std::size_t afterEnd = 0;
};

/// A line is known by a number that is equal for equal lines.
using LineNumbers = std::span<const std::uint32_t>;

/// The changes in ascending order; between two there is at least one equal line.  They always lead from one text to the
/// other; they are as few lines as possible unless the texts differ wildly.
std::vector<LineChange> diffLines(LineNumbers before, LineNumbers after);

} // namespace feedhold
