#include "surface/lsp/documents.h"

#include "base/source/file_uri.h"
#include "base/source/path_text.h"

#include <algorithm>

namespace feedhold::lsp {

namespace {

std::uint32_t size32(std::string_view text) { return static_cast<std::uint32_t>(text.size()); }

} // namespace

Document openDocument(const Json &textDocument) {
  Document document;
  document.uri = textDocument.at("uri").get<std::string>();
  document.version = textDocument.at("version").get<std::int64_t>();
  document.text = std::make_shared<const std::string>(textDocument.at("text").get<std::string>());
  const std::filesystem::path path = pathOfUri(document.uri);
  document.path = isAbsolutePath(path) ? normalPath(path) : std::filesystem::path();
  if (!document.path.empty())
    document.place = placeOf(document.path);
  return document;
}

std::vector<TextChange> applyChanges(Document &document, const Json &contentChanges, PositionEncoding encoding) {
  std::vector<TextChange> changes;
  std::shared_ptr<const std::string> text = document.text; // what came before a change that is wrong stays undone, too
  for (const Json &change : contentChanges) {
    std::string added = change.at("text").get<std::string>();
    if (!change.contains("range")) {
      changes.push_back(difference(*text, added));
      text = std::make_shared<const std::string>(std::move(added));
      continue;
    }
    const Span span = Places(SourceFile::fromText({}, *text), encoding).span(change.at("range"));
    changes.push_back({span.begin, span.size(), size32(added)});
    std::string next;
    next.reserve(text->size() + added.size());
    next.append(*text, 0, span.begin).append(added).append(*text, span.end);
    text = std::make_shared<const std::string>(std::move(next));
  }
  document.text = std::move(text);
  return changes;
}

TextChange difference(std::string_view before, std::string_view after) {
  const std::size_t shorter = std::min(before.size(), after.size());
  std::size_t head = 0, tail = 0;
  while (head < shorter && before[head] == after[head])
    ++head;
  head = before.substr(0, head).rfind('\n') + 1; // npos + 1: the whole text is one line
  while (tail < shorter - head && before[before.size() - 1 - tail] == after[after.size() - 1 - tail])
    ++tail;
  // Whole lines, so that no character and no line end is cut.
  const std::size_t lineEnd = after.substr(after.size() - tail).find('\n');
  tail -= lineEnd == std::string_view::npos ? tail : lineEnd + 1;
  const auto kept = static_cast<std::uint32_t>(head + tail);
  return {static_cast<std::uint32_t>(head), size32(before) - kept, size32(after) - kept};
}

std::optional<Span> moved(Span span, const TextChange &change) {
  if (span.end <= change.at && !(span.end == change.at && change.removed == 0 && span.empty()))
    return span;
  if (span.begin < change.at + change.removed)
    return std::nullopt;
  const std::uint32_t begin = span.begin - change.removed + change.added;
  return Span{begin, begin + span.size()};
}

} // namespace feedhold::lsp
