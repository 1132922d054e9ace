#include "surface/lsp/places.h"

#include "base/source/file_uri.h"
#include "base/source/path_text.h"
#include "findings/project/open_texts.h"

#include <algorithm>

namespace feedhold::lsp {
namespace {

/// The bytes of one character of UTF-8, by its first one; a stray byte counts as one.
std::size_t lengthAt(std::string_view text, std::size_t at) {
  const auto byte = static_cast<unsigned char>(text[at]);
  const std::size_t length = byte < 0xC0 ? 1 : byte < 0xE0 ? 2 : byte < 0xF0 ? 3 : 4;
  return std::min(length, text.size() - at);
}

constexpr std::size_t kBeyondUtf16Unit = 4; // characters of four bytes are two units

std::filesystem::path normal(const std::filesystem::path &path) { return normalPath(absolutePath(path)); }

} // namespace

std::uint32_t Places::units(std::string_view utf8) const {
  if (encoding_ == PositionEncoding::Utf8)
    return static_cast<std::uint32_t>(utf8.size());
  std::uint32_t count = 0;
  for (std::size_t at = 0; at < utf8.size(); at += lengthAt(utf8, at))
    count += lengthAt(utf8, at) == kBeyondUtf16Unit ? 2 : 1;
  return count;
}

nlohmann::json Places::position(std::uint32_t offset) const {
  const auto [line, character] = lineAndCharacter(offset);
  return {{"line", line}, {"character", character}};
}

/// A file of the folder in another encoding: the client will have decoded it when it goes there.
bool Places::isDecodedByClient() const {
  return encoding_ == PositionEncoding::Utf16 && source_.encoding() != Encoding::Ascii &&
         source_.encoding() != Encoding::Utf8;
}

Places::LineAndCharacter Places::lineAndCharacter(std::uint32_t offset, std::uint32_t known,
                                                  LineAndCharacter there) const {
  const Span line = source_.lineSpan(there.line + 1);
  if (offset < known || offset > line.end || isDecodedByClient())
    return lineAndCharacter(offset);
  return {there.line, there.character + units(source_.text(Span{known, offset}))};
}

Places::LineAndCharacter Places::lineAndCharacter(std::uint32_t offset) const {
  if (isDecodedByClient()) {
    const Position position = source_.positionUtf16(offset);
    return {position.line - 1, position.column - 1};
  }
  offset = std::min(offset, static_cast<std::uint32_t>(source_.text().size()));
  const std::uint32_t line = source_.lineOf(offset);
  const Span whole = source_.lineSpan(line);
  const std::uint32_t end = std::clamp(offset, whole.begin, whole.end);
  return {line - 1, units(source_.text(Span{whole.begin, end}))};
}

nlohmann::json Places::range(Span span) const { return {{"start", position(span.begin)}, {"end", position(span.end)}}; }

std::uint32_t Places::offset(const nlohmann::json &position) const {
  const auto line = position.at("line").get<std::uint64_t>();
  const auto wanted = position.at("character").get<std::uint64_t>();
  if (line >= source_.lineCount())
    return static_cast<std::uint32_t>(source_.text().size());
  const Span whole = source_.lineSpan(static_cast<std::uint32_t>(line) + 1);
  const std::string_view text = source_.text(whole);
  std::size_t at = 0;
  std::uint64_t passed = 0;
  while (at < text.size()) {
    const std::size_t length = lengthAt(text, at);
    const std::uint64_t next = passed + units(text.substr(at, length));
    if (next > wanted)
      break;
    passed = next;
    at += length;
  }
  return whole.begin + static_cast<std::uint32_t>(at);
}

Span Places::span(const nlohmann::json &range) const {
  const std::uint32_t begin = offset(range.at("start")), end = offset(range.at("end"));
  return {std::min(begin, end), std::max(begin, end)};
}

void OpenUris::add(const std::filesystem::path &path, const std::string &uri) {
  const std::filesystem::path written = normal(path);
  documents_[written] = uri;
  documents_.try_emplace(placeOf(path), uri);
  const std::string folder = uri.substr(0, uri.rfind('/') + 1); // not one whose last `/` is escaped
  if (normal(pathOfUri(folder)) == written.parent_path() / "")
    folders_.try_emplace(written.parent_path(), folder);
}

std::string OpenUris::of(const std::filesystem::path &path) const {
  const std::filesystem::path written = normal(path);
  if (const auto open = documents_.find(written); open != documents_.end())
    return open->second;
  if (const auto open = documents_.find(placeOf(path)); open != documents_.end())
    return open->second;
  const auto folder = folders_.find(written.parent_path());
  return folder == folders_.end() ? uriOfPath(path) : folder->second + escapedForUri(pathText(written.filename()));
}

} // namespace feedhold::lsp
