#include "proof/decide/linear_algebra.h"

namespace feedhold::prove {

using smt::Number;

namespace {

/// row - factor * other
void subtract(std::vector<Number> &row, const Number &factor, const std::vector<Number> &other) {
  for (std::size_t column = 0; column < row.size(); ++column)
    row[column] = row[column] - factor * other[column];
}

} // namespace

/// By reduction to row echelon form (Gauss, Jordan).
std::vector<std::vector<Number>> nullSpace(std::vector<std::vector<Number>> rows, std::size_t columns) {
  std::vector<std::size_t> pivots; // the column of each reduced row
  for (std::size_t column = 0; column < columns && pivots.size() < rows.size(); ++column) {
    std::size_t pivot = pivots.size();
    while (pivot < rows.size() && rows[pivot][column].isZero())
      ++pivot;
    if (pivot == rows.size())
      continue;
    const std::size_t place = pivots.size();
    std::swap(rows[place], rows[pivot]);
    const Number scale = Number(1) / rows[place][column];
    for (Number &entry : rows[place])
      entry = entry * scale;
    for (std::size_t row = 0; row < rows.size(); ++row)
      if (row != place && !rows[row][column].isZero())
        subtract(rows[row], Number(rows[row][column]), rows[place]);
    pivots.push_back(column);
  }
  std::vector<std::vector<Number>> basis;
  std::size_t next = 0;
  for (std::size_t column = 0; column < columns; ++column) {
    if (next < pivots.size() && pivots[next] == column) {
      ++next;
      continue;
    }
    std::vector<Number> vector(columns);
    vector[column] = Number(1);
    for (std::size_t row = 0; row < pivots.size(); ++row)
      vector[pivots[row]] = Number(-1) * rows[row][column];
    basis.push_back(std::move(vector));
  }
  return basis;
}

} // namespace feedhold::prove
