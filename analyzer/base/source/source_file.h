// SourceFile: the bytes of one program file, how they are encoded, and where its lines begin.
#pragma once

#include "base/source/encoding.h"
#include "base/source/span.h"
#include "base/support/result.h"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace feedhold {

/// 1-based line and 1-based column; the column counts characters or UTF-16 units, as the function that made it says.
struct Position {
  std::uint32_t line = 1;
  std::uint32_t column = 1;
  friend auto operator<=>(const Position &, const Position &) = default;
};

/// Cheap to copy: copies share the bytes.  The line table and the encoding are found at first need.
class SourceFile {
public:
  /// The largest file that is read; spans are 32 bits wide and the tree of a larger file would not fit a PC.
  static constexpr std::uint64_t kLargestSize = std::uint64_t{1} << 30;

  /// Memory-maps a regular file.  Errors: missing, unreadable, a directory or a device, larger than kLargestSize.
  static Result<SourceFile> open(const std::filesystem::path &path);
  static SourceFile fromText(std::string path, std::string text);

  const std::string &path() const;
  std::string_view text() const;
  std::string_view text(Span span) const { return text().substr(span.begin, span.size()); }

  Encoding encoding() const;
  /// Any byte range of this file as UTF-8, decoded by encoding(); bytes that do not decode become U+FFFD.
  std::string utf8(Span span) const;

  /// Lines end at LF, CR LF, CR CR LF or a lone CR.  The last line is what follows the last end, and may be empty.
  std::uint32_t lineCount() const;
  /// The bytes of a line end belong to the line that they end; an offset behind the text is on the last line.
  std::uint32_t lineOf(std::uint32_t offset) const;
  /// The bytes of a 1-based line, without its end.
  Span lineSpan(std::uint32_t line) const;
  /// Column in characters (Unicode code points of the decoded line, not counting a byte-order mark), for people and
  /// JSON.
  Position position(std::uint32_t offset) const;
  /// Column in UTF-16 code units, for SARIF and editors.
  Position positionUtf16(std::uint32_t offset) const;

private:
  struct Contents;
  explicit SourceFile(std::shared_ptr<const Contents> contents);
  std::shared_ptr<const Contents> contents_;
};

} // namespace feedhold
