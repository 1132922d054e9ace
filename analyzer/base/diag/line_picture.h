// LinePicture: one source line as a terminal can show it, and where bytes of the line are in the picture.
// Internal to diag/.
#pragma once

#include "base/source/source_file.h"

#include <string>
#include <string_view>
#include <vector>

namespace feedhold {

/// A half-open range of terminal cells, counted from 0.
struct Columns {
  std::size_t begin = 0;
  std::size_t end = 0;
};

class LinePicture {
public:
  struct Limits {
    std::uint32_t tabWidth;
    std::uint32_t maxWidth;
  };

  /// A line wider than the limit is cut to a window that shows all of `marks`, or the first of them if they are far
  /// apart.  `marks` are spans of the file that begin on the line.
  LinePicture(const SourceFile &source, std::uint32_t line, const std::vector<Span> &marks, Limits limits);

  std::string text() const;
  /// The cells of the part of `span` on this line; at least one, behind the line if need be.
  Columns columnsOf(Span span) const;

private:
  /// One character, or an ellipsis that stands for many.
  struct Cell {
    Span bytes;
    std::string text;
    std::size_t width;
  };
  void cutToWindow(Span line, Columns focus, std::size_t width);
  std::size_t width() const;

  std::vector<Cell> cells_;
};

/// UTF-8 text with control characters, and those that turn the writing direction, made visible and harmless.
std::string printable(std::string_view utf8);

} // namespace feedhold
