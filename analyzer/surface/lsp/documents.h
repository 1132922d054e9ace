// Documents: the texts that editors have open, and how they change.
#pragma once

#include "findings/project/open_texts.h"
#include "surface/lsp/places.h"

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold::lsp {

using Json = nlohmann::json;

struct Document {
  std::string uri;             // as the client writes it
  std::filesystem::path path;  // absolute; empty: of no file
  std::filesystem::path place; // the same without links
  std::int64_t version = 0;
  std::shared_ptr<const std::string> text; // UTF-8
};

/// `removed` bytes at `at` became `added` others.
struct TextChange {
  std::uint32_t at;
  std::uint32_t removed;
  std::uint32_t added;
};

/// What `textDocument/didOpen` brings.  Throws an exception of nlohmann::json for other parameters.
Document openDocument(const Json &textDocument);

/// Applies `contentChanges`, each to what the one before has left.  A change without a range is the whole text.
std::vector<TextChange> applyChanges(Document &document, const Json &contentChanges, PositionEncoding encoding);

/// What leads from one text to another: all lines but those that are the same at both ends.
TextChange difference(std::string_view before, std::string_view after);

/// Where a span is after a change; absent when the change touches it.
std::optional<Span> moved(Span span, const TextChange &change);

} // namespace feedhold::lsp
