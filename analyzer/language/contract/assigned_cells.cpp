#include "language/contract/assigned_cells.h"

#include <algorithm>

namespace feedhold {

std::set<std::uint32_t> assignedCells(const Dialect &dialect, const std::vector<Assigns> &clauses) {
  std::set<std::uint32_t> cells;
  for (const Assigns &clause : clauses)
    for (const Assigns::Variables &range : clause.variables)
      for (const VariableRange &row : dialect.variables)
        for (std::uint32_t number = std::max(range.first, row.first); number <= std::min(range.last, row.last);
             ++number) {
          cells.insert(cellOf(dialect, number));
          if (const BitWord *word = findBitWord(dialect, number))
            for (std::uint32_t bit = 0; bit < word->bits; ++bit)
              cells.insert(word->firstBit + bit);
        }
  return cells;
}

} // namespace feedhold
