// Placing carets, dashes and label texts.
#include "base/diag/marker_rows.h"

#include <algorithm>

namespace feedhold {

namespace {

Style styleOf(MarkerKind kind) { return kind == MarkerKind::Primary ? Style::Severity : Style::Secondary; }

/// A row of single cells of one style each; a text may only be the last thing in it.
class Row {
public:
  void put(Columns columns, char glyph, Style style) {
    for (std::size_t at = columns.begin; at < columns.end; ++at) {
      while (cells_.size() <= at)
        cells_.push_back({" ", Style::Plain});
      cells_[at] = {std::string(1, glyph), style};
    }
  }
  void append(std::size_t column, const std::string &text, Style style) {
    while (cells_.size() < column)
      cells_.push_back({" ", Style::Plain});
    cells_.push_back({text, style});
  }
  StyledLine line() const {
    StyledLine merged;
    for (const Piece &cell : cells_) {
      if (merged.empty() || merged.back().style != cell.style)
        merged.push_back({"", cell.style});
      merged.back().text += cell.text;
    }
    return merged;
  }

private:
  StyledLine cells_;
};

Row marksOf(const std::vector<Marker> &markers) {
  Row row;
  for (const Marker &marker : markers)
    if (marker.kind == MarkerKind::Secondary)
      row.put(marker.columns, '-', Style::Secondary);
  for (const Marker &marker : markers)
    if (marker.kind == MarkerKind::Primary)
      row.put(marker.columns, '^', Style::Severity);
  return row;
}

/// The lines that lead down to the first `count` markers, as far as they are left of `limit`.
Row tiesTo(const std::vector<Marker> &markers, std::size_t count, std::size_t limit) {
  Row row;
  for (std::size_t i = 0; i < count; ++i)
    if (markers[i].columns.begin < limit)
      row.put({markers[i].columns.begin, markers[i].columns.begin + 1}, '|', styleOf(markers[i].kind));
  return row;
}

} // namespace

std::vector<StyledLine> markerRows(std::vector<Marker> markers) {
  std::ranges::stable_sort(markers, {}, [](const Marker &marker) { return marker.columns.begin; });
  std::size_t right = 0;
  for (const Marker &marker : markers)
    right = std::max(right, marker.columns.end);

  Row marks = marksOf(markers);
  if (markers.back().columns.end == right) {
    if (!markers.back().text.empty())
      marks.append(right + 1, markers.back().text, styleOf(markers.back().kind));
    markers.pop_back();
  }
  std::vector<StyledLine> rows = {marks.line()};
  std::erase_if(markers, [](const Marker &marker) { return marker.text.empty(); });
  if (!markers.empty())
    rows.push_back(tiesTo(markers, markers.size(), right).line());
  for (std::size_t i = markers.size(); i-- > 0;) {
    const std::size_t column = markers[i].columns.begin;
    Row row = tiesTo(markers, i, column);
    row.append(column, markers[i].text, styleOf(markers[i].kind));
    rows.push_back(row.line());
  }
  return rows;
}

} // namespace feedhold
