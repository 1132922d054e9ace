// SourceFile: shared bytes with a line index and an encoding found at first need.
#include "base/source/source_file.h"

#include "base/source/line_index.h"
#include "base/source/memory_map.h"
#include "base/source/path_text.h"

#include <algorithm>
#include <mutex>
#include <utility>

namespace feedhold {

/// Either `owned` or `map` holds the bytes; `text` is a view of them.
struct SourceFile::Contents {
  Contents(std::string name, std::string bytes) : path(std::move(name)), owned(std::move(bytes)), text(owned) {}
  Contents(std::string name, MemoryMap mapped) : path(std::move(name)), map(std::move(mapped)), text(map.bytes()) {}
  Contents(const Contents &) = delete;
  Contents &operator=(const Contents &) = delete;

  const LineIndex &lines() const {
    std::call_once(linesFound_, [this] { lines_ = LineIndex(text); });
    return lines_;
  }
  Encoding encoding() const {
    std::call_once(encodingFound_, [this] { encoding_ = detectEncoding(text); });
    return encoding_;
  }

  const std::string path;
  const std::string owned;
  const MemoryMap map;
  const std::string_view text;

private:
  mutable std::once_flag linesFound_;
  mutable LineIndex lines_;
  mutable std::once_flag encodingFound_;
  mutable Encoding encoding_ = Encoding::Ascii;
};

namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

enum class ColumnUnit { Characters, Utf16Units };

/// One character of a valid encoding is one code point; only four bytes of UTF-8 make two UTF-16 units.
std::uint32_t unitsOf(std::size_t bytes, ColumnUnit unit) {
  return unit == ColumnUnit::Utf16Units && bytes == 4 ? 2 : 1;
}

/// The column of `offset` in the line that begins at `begin`.  A byte-order mark is not part of the first line.
std::uint32_t columnOf(const SourceFile &source, std::uint32_t begin, std::uint32_t offset, ColumnUnit unit) {
  const std::string_view text = source.text();
  const Encoding encoding = source.encoding();
  std::size_t at =
      begin == 0 && encoding == Encoding::Utf8 && text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : begin;
  if (offset <= at)
    return 1;
  if (encoding == Encoding::Ascii || encoding == Encoding::Latin1)
    return offset - begin + 1;
  std::uint32_t column = 1;
  while (at < offset) {
    const std::size_t length = characterLength(text, at, encoding);
    if (at + length > offset) // inside a character: its own column
      break;
    column += unitsOf(length, unit);
    at += length;
  }
  return column;
}

Position positionOf(const SourceFile &source, std::uint32_t offset, ColumnUnit unit) {
  const auto clamped = std::min(offset, static_cast<std::uint32_t>(source.text().size()));
  const std::uint32_t line = source.lineOf(clamped);
  return {line, columnOf(source, source.lineSpan(line).begin, clamped, unit)};
}

} // namespace

SourceFile::SourceFile(std::shared_ptr<const Contents> contents) : contents_(std::move(contents)) {}

Result<SourceFile> SourceFile::open(const std::filesystem::path &path) {
  Result<MemoryMap> map = MemoryMap::open(path, kLargestSize);
  if (!map)
    return map.error();
  return SourceFile(std::make_shared<const Contents>(pathText(path), map.take()));
}

SourceFile SourceFile::fromText(std::string path, std::string text) {
  FEEDHOLD_CHECK(text.size() <= kLargestSize, "a text larger than spans can speak of");
  return SourceFile(std::make_shared<const Contents>(std::move(path), std::move(text)));
}

const std::string &SourceFile::path() const { return contents_->path; }
std::string_view SourceFile::text() const { return contents_->text; }
Encoding SourceFile::encoding() const { return contents_->encoding(); }
std::string SourceFile::utf8(Span span) const { return toUtf8(text(span), encoding()); }

std::uint32_t SourceFile::lineCount() const { return contents_->lines().lineCount(); }
std::uint32_t SourceFile::lineOf(std::uint32_t offset) const { return contents_->lines().lineOf(text(), offset); }

Span SourceFile::lineSpan(std::uint32_t line) const {
  FEEDHOLD_CHECK(line >= 1 && line <= lineCount(), "a line that the file does not have");
  return contents_->lines().lineSpan(text(), line);
}

Position SourceFile::position(std::uint32_t offset) const { return positionOf(*this, offset, ColumnUnit::Characters); }

Position SourceFile::positionUtf16(std::uint32_t offset) const {
  return positionOf(*this, offset, ColumnUnit::Utf16Units);
}

} // namespace feedhold
