// The outline of a document and the programs of its folder.
#include "base/support/text.h"
#include "surface/lsp/feature_handlers.h"
#include "surface/lsp/feature_json.h"
#include "surface/lsp/feature_meaning.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::lsp {

namespace {

constexpr int kFunction = 12; // SymbolKind
constexpr int kKey = 20;      // a sequence number
constexpr int kOperator = 25; // a loop

struct Symbol {
  std::string name;
  std::string detail;
  int kind;
  Span whole;
  Span name_;
  std::vector<Symbol> inside = {};
};

/// The place of a symbol that is not in one of the earlier ones' loops: symbols come by place.
void put(std::vector<Symbol> &into, Symbol symbol) {
  if (!into.empty() && into.back().whole.contains(symbol.whole) && into.back().kind != kKey)
    return put(into.back().inside, std::move(symbol));
  into.push_back(std::move(symbol));
}

Json jsonOf(const View &view, const std::vector<Symbol> &symbols) {
  Json found = Json::array();
  for (const Symbol &symbol : symbols) {
    Json each{{"name", symbol.name},
              {"kind", symbol.kind},
              {"range", rangeOf(view, kDocument, symbol.whole)},
              {"selectionRange", rangeOf(view, kDocument, symbol.name_)}};
    if (!symbol.detail.empty())
      each["detail"] = symbol.detail;
    if (!symbol.inside.empty())
      each["children"] = jsonOf(view, symbol.inside);
    found.push_back(std::move(each));
  }
  return found;
}

class Outline {
public:
  explicit Outline(const ProjectFile &file) : file_(file) {}

  std::vector<Symbol> build() {
    for (std::size_t i = 0; i < file_.model.programs.size(); ++i)
      program(ProgramId(i));
    for (const SequenceNumber &each : file_.model.sequenceNumbers)
      symbols_.push_back({fmt::format("N{}", each.number), commentIn(each.block), kKey,
                          file_.tree.blocks[each.block].span(), file_.tree.words[each.word].span()});
    for (const Loop &each : file_.model.loops)
      loop(each);
    for (const Construct &each : file_.model.constructs)
      construct(each);
    std::stable_sort(symbols_.begin(), symbols_.end(), [](const Symbol &a, const Symbol &b) {
      return a.whole.begin != b.whole.begin ? a.whole.begin < b.whole.begin : a.whole.end > b.whole.end;
    });
    std::vector<Symbol> nested;
    for (Symbol &symbol : symbols_)
      put(nested, std::move(symbol));
    return nested;
  }

private:
  void program(ProgramId id) {
    const ProgramName &name = file_.model.programs[id].name;
    if (name.empty() && file_.tree.words.empty() && file_.tree.statements.empty())
      return;
    symbols_.push_back({name.empty() ? "unnamed program" : toString(name), titleOf(file_, id), kFunction,
                        spanOf(file_, id), nameSpanOf(file_, id)});
  }
  std::string commentIn(BlockId block) const {
    const auto comments = file_.tree.commentsOf(block);
    return comments.empty() ? "" : file_.source.utf8(comments.front().span);
  }
  void loop(const Loop &loop) {
    const Span head = file_.tree.statements[loop.doStatement].span;
    const Span end = loop.endStatement ? file_.tree.statements[*loop.endStatement].span : head;
    const Span block = file_.tree.blocks[loop.doBlock].span(); // so that the N before it is in it
    symbols_.push_back({file_.source.utf8(head), "", kOperator, cover(block, end), head});
  }
  void construct(const Construct &construct) {
    if (construct.kind == OWordKind::Sub) // a program
      return;
    const auto spanOfPart = [&](OWordId part) {
      return file_.tree.statements[file_.model.oWords[part].statement].span;
    };
    const Span head = spanOfPart(construct.parts.front());
    symbols_.push_back({file_.source.utf8(head), "", kOperator, cover(head, spanOfPart(construct.parts.back())), head});
  }

  const ProjectFile &file_;
  std::vector<Symbol> symbols_;
};

} // namespace

Json documentSymbol(const View &view, const Json &) { return jsonOf(view, Outline(view.file()).build()); }

Json workspaceSymbol(const View &document, const Json &params) {
  const View view = withFolder(document);
  const std::string query = toUpper(params.at("query").get<std::string>());
  Json found = Json::array();
  for (std::size_t i = 0; i < view.programs->files.size(); ++i) {
    const ProjectFile &file = *view.programs->files[i];
    for (std::size_t p = 0; p < file.model.programs.size(); ++p) {
      const ProgramName &name = file.model.programs[ProgramId(p)].name;
      const std::string title = titleOf(file, ProgramId(p));
      const std::string shown = title.empty() ? toString(name) : fmt::format("{} ({})", toString(name), title);
      if (!name.empty() && toUpper(shown).find(query) != std::string::npos)
        found.push_back({{"name", shown},
                         {"kind", kFunction},
                         {"location", locationOf(view, FileId(i), nameSpanOf(file, ProgramId(p)))}});
    }
  }
  return found;
}

} // namespace feedhold::lsp
