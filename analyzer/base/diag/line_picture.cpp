// Pictures of source lines: tabs, wide characters, control bytes, windows of long lines.
#include "base/diag/line_picture.h"

#include "base/diag/display_width.h"

#include <algorithm>
#include <bit>

namespace feedhold {

namespace {

constexpr char32_t kReplacement = 0xFFFD;
constexpr char32_t kByteOrderMark = 0xFEFF;

/// The first code point of well-formed UTF-8.
char32_t codePointOf(std::string_view utf8) {
  const auto first = static_cast<std::uint8_t>(utf8[0]);
  if (first < 0x80)
    return first;
  const int length = std::countl_one(first);
  char32_t codePoint = first & (0xFFU >> (length + 1));
  for (const char c : utf8.substr(1, static_cast<std::size_t>(length) - 1))
    codePoint = (codePoint << 6) | (static_cast<std::uint8_t>(c) & 0x3FU);
  return codePoint;
}

/// C1 controls, line and paragraph separators, and the bidirectional overrides with which a comment can be made to look
/// like code ("Trojan Source", CVE-2021-42574).
bool isHarmful(char32_t c) {
  return (c >= 0x80 && c <= 0x9F) || (c >= 0x2028 && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069);
}

/// U+2400 and on picture the ASCII controls.
char32_t visible(char32_t codePoint) {
  if (codePoint < 0x20)
    return 0x2400 + codePoint;
  if (codePoint == 0x7F)
    return 0x2421;
  return isHarmful(codePoint) ? kReplacement : codePoint;
}

struct Glyph {
  std::string text;
  std::size_t width;
};

Glyph glyphOf(std::string_view utf8, std::size_t column, std::size_t tabWidth) {
  const char32_t codePoint = codePointOf(utf8);
  if (codePoint == '\t') {
    const std::size_t width = tabWidth - column % tabWidth;
    return {std::string(width, ' '), width};
  }
  if (codePoint == kByteOrderMark)
    return {"", 0};
  Glyph glyph = {"", displayWidth(visible(codePoint))};
  appendUtf8(glyph.text, visible(codePoint));
  return glyph;
}

/// The bytes to look at: all of a usual line; of a very long one enough around the first mark to fill any window.
Span bytesNear(const SourceFile &source, Span line, Span mark, std::uint32_t maxWidth) {
  constexpr std::uint32_t kLongestCharacter = 4;
  const auto largest = static_cast<std::uint32_t>(SourceFile::kLargestSize);
  const std::uint32_t reach = std::min(maxWidth, largest / kLongestCharacter) * kLongestCharacter;
  const std::uint32_t centre = std::clamp(mark.begin, line.begin, line.end);
  const std::uint32_t begin = centre - line.begin > reach ? centre - reach : line.begin;
  const std::uint32_t end = line.end - centre > reach ? centre + reach : line.end;
  const auto aligned = [&](std::uint32_t at) {
    if (at == line.begin || at == line.end)
      return at;
    return static_cast<std::uint32_t>(characterBegin(source.text(), line.begin, at, source.encoding()));
  };
  return {aligned(begin), aligned(end)};
}

} // namespace

LinePicture::LinePicture(const SourceFile &source, std::uint32_t line, const std::vector<Span> &marks, Limits limits) {
  constexpr std::uint32_t kLeastWidth = 20;
  const std::uint32_t maxWidth = std::max(limits.maxWidth, kLeastWidth);
  const Span whole = source.lineSpan(line);
  const Span bytes = bytesNear(source, whole, marks.front(), maxWidth);
  const std::string_view text = source.text().substr(0, bytes.end);
  std::size_t column = 0;
  for (std::uint32_t at = bytes.begin; at < bytes.end;) {
    const auto next = static_cast<std::uint32_t>(at + characterLength(text, at, source.encoding()));
    Glyph glyph = glyphOf(source.utf8({at, next}), column, std::max(1U, limits.tabWidth));
    column += glyph.width;
    cells_.push_back({{at, next}, std::move(glyph.text), glyph.width});
    at = next;
  }
  if (bytes == whole && column <= maxWidth)
    return;
  Columns focus = columnsOf(marks.front());
  for (const Span mark : marks) {
    const Columns more = columnsOf(mark);
    const Columns all = {std::min(focus.begin, more.begin), std::max(focus.end, more.end)};
    if (all.end - all.begin <= maxWidth)
      focus = all;
  }
  cutToWindow(whole, focus, maxWidth);
}

void LinePicture::cutToWindow(Span line, Columns focus, std::size_t width) {
  constexpr std::size_t kEllipsis = 1;
  const std::size_t spare = width - std::min(width, focus.end - focus.begin);
  const std::size_t lead = std::max(spare / 2, kEllipsis); // the ellipsis must not hide what is marked
  const std::size_t total = this->width();
  const std::size_t first = std::min(focus.begin - std::min(focus.begin, lead), total - std::min(total, width));
  const bool cutBefore = first > 0 || cells_.front().bytes.begin > line.begin;
  const bool cutBehind = first + width < total || cells_.back().bytes.end < line.end;
  const std::size_t begin = first + (cutBefore ? kEllipsis : 0);
  const std::size_t end = first + width - (cutBehind ? kEllipsis : 0);
  std::vector<Cell> shown;
  std::size_t column = 0;
  for (const Cell &cell : cells_) {
    if (column >= begin && column + cell.width <= end)
      shown.push_back(cell);
    column += cell.width;
  }
  const Span kept =
      shown.empty() ? Span{line.begin, line.begin} : Span{shown.front().bytes.begin, shown.back().bytes.end};
  if (kept.begin > line.begin)
    shown.insert(shown.begin(), Cell{{line.begin, kept.begin}, "…", kEllipsis});
  if (kept.end < line.end)
    shown.push_back(Cell{{kept.end, line.end}, "…", kEllipsis});
  cells_ = std::move(shown);
}

std::string LinePicture::text() const {
  std::string result;
  for (const Cell &cell : cells_)
    result += cell.text;
  return result;
}

std::size_t LinePicture::width() const {
  std::size_t sum = 0;
  for (const Cell &cell : cells_)
    sum += cell.width;
  return sum;
}

Columns LinePicture::columnsOf(Span span) const {
  Columns columns;
  for (const Cell &cell : cells_) {
    if (cell.bytes.end <= span.begin)
      columns.begin += cell.width;
    if (cell.bytes.begin < span.end)
      columns.end += cell.width;
  }
  columns.end = std::max(columns.end, columns.begin + 1);
  return columns;
}

std::string printable(std::string_view utf8) {
  std::string result;
  for (std::size_t at = 0; at < utf8.size();) {
    const std::size_t length = characterLength(utf8, at, Encoding::Utf8);
    appendUtf8(result, visible(codePointOf(toUtf8(utf8.substr(at, length), Encoding::Utf8))));
    at += length;
  }
  return result;
}

} // namespace feedhold
