// LineIndex: where the lines of a text end.  It keeps one entry per 256 bytes of text, not one per line, so that it is
// built at nearly the speed of memory; a query looks at one stretch of 256 bytes.  Internal to source/.
#pragma once

#include "base/source/span.h"

#include <string_view>
#include <vector>

namespace feedhold {

/// Lines end at LF, at CR LF or any longer run of CRs before an LF, or at a lone CR.  The text is passed to each query
/// and must be the one that was indexed.
class LineIndex {
public:
  LineIndex() = default;
  explicit LineIndex(std::string_view text);

  /// The number of line ends, plus one.
  std::uint32_t lineCount() const { return lineEnds_ + 1; }
  /// The 1-based line of a byte; the bytes of a line end belong to the line that they end.
  std::uint32_t lineOf(std::string_view text, std::uint32_t offset) const;
  /// The bytes of a 1-based line without its end.
  Span lineSpan(std::string_view text, std::uint32_t line) const;

private:
  struct Chunk {
    std::uint32_t endsBefore; // line ends in all chunks before this one
    bool startsInLineEnd;     // its first byte that is not CR is LF
  };
  bool lineFeedFollows(std::size_t chunk) const;
  /// The offset just behind the last byte of the `number`-th line end, counted from 1.
  std::uint32_t behindLineEnd(std::string_view text, std::uint32_t number) const;

  std::vector<Chunk> chunks_;
  std::uint32_t lineEnds_ = 0;
};

} // namespace feedhold
