// Building tables at compile time: several tables into one that is sorted; a row that two tables share is an error.
#pragma once

#include "language/dialect/dialect.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace feedhold {

constexpr std::uint32_t firstOf(const Code &code) { return code.tenths; }
constexpr std::uint32_t lastOf(const Code &code) { return code.tenths; }
constexpr std::uint32_t firstOf(const VariableRange &range) { return range.first; }
constexpr std::uint32_t lastOf(const VariableRange &range) { return range.last; }

template <typename Row, std::size_t N> consteval std::array<Row, N> sorted(std::array<Row, N> rows) {
  std::sort(rows.begin(), rows.end(), [](const Row &a, const Row &b) { return firstOf(a) < firstOf(b); });
  for (std::size_t i = 0; i < N; ++i)
    if (firstOf(rows[i]) > lastOf(rows[i]) || (i > 0 && firstOf(rows[i]) <= lastOf(rows[i - 1])))
      throw "two rows overlap";
  return rows;
}

template <typename Row, std::size_t... Sizes> consteval auto joined(const std::array<Row, Sizes> &...tables) {
  std::array<Row, (Sizes + ...)> all{};
  std::size_t next = 0;
  const auto append = [&](const auto &table) {
    for (const Row &row : table)
      all[next++] = row;
  };
  (append(tables), ...);
  return all;
}

/// Tables of codes or of variables, as one sorted table.
template <typename Row, std::size_t... Sizes> consteval auto merged(const std::array<Row, Sizes> &...tables) {
  return sorted(joined(tables...));
}

/// Sorted by name; each gets the number of its place.
template <std::size_t N> consteval std::array<PredefinedName, N> predefined(std::array<PredefinedName, N> names) {
  std::sort(names.begin(), names.end(),
            [](const PredefinedName &a, const PredefinedName &b) { return a.row.name < b.row.name; });
  for (std::size_t i = 0; i < N; ++i) {
    if (i > 0 && names[i].row.name == names[i - 1].row.name)
      throw "two rows of one name";
    names[i].row.first = names[i].row.last = kFirstPredefinedName + static_cast<std::uint32_t>(i);
  }
  return names;
}

} // namespace feedhold
