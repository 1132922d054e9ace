// Where the name at a place is defined, and all places that use it.
#include "surface/lsp/feature_handlers.h"
#include "surface/lsp/feature_json.h"

namespace feedhold::lsp {

namespace {

constexpr int kRead = 2; // DocumentHighlightKind
constexpr int kWrite = 3;

std::vector<Use> usesAt(const View &view, const Json &params) {
  const auto symbol = symbolAt(view, params);
  return symbol ? usesOf(*view.programs, symbol->symbol) : std::vector<Use>();
}

/// From either end of a loop to the other one.
Json otherEnds(const View &view, const std::vector<Use> &uses, Span here) {
  Json found = Json::array();
  for (const Use &use : uses)
    if (use.span != here)
      found.push_back(locationOf(view, use));
  return found.empty() ? Json() : found;
}

} // namespace

Json definition(const View &document, const Json &params) {
  const View view = withFolder(document); // callers give arguments their first values
  const auto symbol = symbolAt(view, params);
  if (!symbol)
    return nullptr;
  const std::vector<Use> uses = usesOf(*view.programs, symbol->symbol);
  if (std::holds_alternative<LoopSymbol>(symbol->symbol) || std::holds_alternative<OWordSymbol>(symbol->symbol))
    return otherEnds(view, uses, symbol->span);
  if (const auto *jump = std::get_if<JumpSymbol>(&symbol->symbol)) {
    const Jump &from = view.file().model.jumps[jump->jump];
    if (from.target && from.kind != JumpKind::ReturnTo) // of several with one number the one that is found first
      return locationOf(view, kDocument, view.file().tree.blocks[*from.target].span());
  }
  Json found = Json::array();
  for (const Use &use : uses)
    if (use.role == UseRole::Definition)
      found.push_back(locationOf(view, use));
  return found.empty() ? Json() : found;
}

Json references(const View &document, const Json &params) {
  const View view = withFolder(document);
  const Json context = params.value("context", Json::object());
  const bool withDefinition = context.value("includeDeclaration", true);
  Json found = Json::array();
  for (const Use &use : usesAt(view, params))
    if (withDefinition || use.role == UseRole::Reference)
      found.push_back(locationOf(view, use));
  return found.empty() ? Json() : found;
}

Json documentHighlight(const View &view, const Json &params) {
  Json found = Json::array();
  for (const Use &use : usesAt(view, params))
    if (use.file == kDocument)
      found.push_back(
          {{"range", rangeOf(view, kDocument, use.span)}, {"kind", use.role == UseRole::Definition ? kWrite : kRead}});
  return found.empty() ? Json() : found;
}

} // namespace feedhold::lsp
