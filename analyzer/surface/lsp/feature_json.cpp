#include "surface/lsp/feature_json.h"

#include "base/source/path_text.h"

#include <algorithm>

namespace feedhold::lsp {

std::string View::uriOf(FileId id) const {
  const ProjectFile &loaded = programs->file(id);
  return id == kDocument || loaded.path.empty() ? uri : uris->of(loaded.path);
}

View withFolder(const View &view) {
  View whole = view;
  if (view.file().path.empty() || !view.file().model.calls.empty()) // then it is loaded with them
    return whole;
  const ProgramOptions options{.path = pathText(view.file().path),
                               .control = {.dialect = std::string(view.programs->dialect().id)},
                               .open = view.open,
                               .folder = ProgramOptions::Folder::Always,
                               .store = view.store};
  auto loaded = loadProject(options, view.known);
  if (loaded && loaded.value()->file(kDocument).source.text() == view.file().source.text())
    whole.programs = loaded.take();
  return whole;
}

std::uint32_t offsetOf(const View &view, const Json &params) { return view.places().offset(params.at("position")); }

std::optional<SymbolAt> symbolAt(const View &view, const Json &params) {
  return symbolAt(*view.programs, offsetOf(view, params));
}

Json rangeOf(const View &view, FileId file, Span span) { return view.places(file).range(span); }

Json locationOf(const View &view, FileId file, Span span) {
  return {{"uri", view.uriOf(file)}, {"range", rangeOf(view, file, span)}};
}

Json locationOf(const View &view, const Use &use) { return locationOf(view, use.file, use.span); }

Json markdown(std::string text) { return {{"kind", "markdown"}, {"value", std::move(text)}}; }

std::string plain(std::string_view text) {
  constexpr std::string_view kMarks = "\\`*_<>[]~|&";
  std::string result;
  for (const char c : text) {
    if (kMarks.find(c) != std::string_view::npos)
      result += '\\';
    result += c;
  }
  return result;
}

Span spanOf(const ProjectFile &file, ProgramId program) {
  const Program &named = file.model.programs[program];
  Span span = file.tree.blocks[named.first].span();
  for (BlockId block = named.first; block < named.last && block.index() < file.tree.blockCount(); block = block.next())
    if (const Block &each = file.tree.blocks[block];
        !each.span().empty() && !each.has(Block::kAfterEnd) && !each.has(Block::kLeader))
      span = cover(span, each.span());
  return cover(span, nameSpanOf(file, program));
}

Span nameSpanOf(const ProjectFile &file, ProgramId program) { return file.model.programs[program].header; }

} // namespace feedhold::lsp
