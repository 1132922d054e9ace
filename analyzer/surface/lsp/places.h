// Places: lines and characters as an editor counts them, and offsets in a text.
#pragma once

#include "base/source/source_file.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace feedhold::lsp {

/// Units in which a client counts within a line.
enum class PositionEncoding : std::uint8_t { Utf8, Utf16 };

class Places {
public:
  Places(SourceFile source, PositionEncoding encoding) : source_(std::move(source)), encoding_(encoding) {}

  struct LineAndCharacter {
    std::uint32_t line;
    std::uint32_t character;
  };
  /// Both from 0.
  LineAndCharacter lineAndCharacter(std::uint32_t offset) const;
  /// The same, where the place of an offset that does not lie behind is known: a long line is not counted from its
  /// head.
  LineAndCharacter lineAndCharacter(std::uint32_t offset, std::uint32_t known, LineAndCharacter there) const;
  /// `{"line": 0, "character": 0}`, both from 0.
  nlohmann::json position(std::uint32_t offset) const;
  /// `{"start": .., "end": ..}`
  nlohmann::json range(Span span) const;
  /// Of a position from the client; behind the end of a line or of the text: that end.
  std::uint32_t offset(const nlohmann::json &position) const;
  Span span(const nlohmann::json &range) const;

private:
  bool isDecodedByClient() const;
  std::uint32_t units(std::string_view utf8) const;

  SourceFile source_;
  PositionEncoding encoding_;
};

/// How the client writes the URIs of the documents that are open: it may escape more than `uriOfPath`, or go by a link,
/// and takes another spelling for another document.
class OpenUris {
public:
  void add(const std::filesystem::path &path, const std::string &uri);
  /// Of an open document as the client writes it; of a file beside one in the same manner.
  std::string of(const std::filesystem::path &path) const;

private:
  std::map<std::filesystem::path, std::string> documents_; // by path as it is written, and without links
  std::map<std::filesystem::path, std::string> folders_;   // by path as it is written; with a `/` at the end
};

} // namespace feedhold::lsp
