#include "surface/lsp/feature_handlers.h"

#include <array>

namespace feedhold::lsp {

namespace {

constexpr std::array kFeatures{
    Feature{"textDocument/hover", hover},
    Feature{"textDocument/definition", definition},
    Feature{"textDocument/references", references},
    Feature{"textDocument/documentHighlight", documentHighlight},
    Feature{"textDocument/documentSymbol", documentSymbol},
    Feature{"workspace/symbol", workspaceSymbol},
};

} // namespace

std::span<const Feature> features() { return kFeatures; }

Json featureCapabilities() {
  return {{"hoverProvider", true},          {"definitionProvider", true},
          {"referencesProvider", true},     {"documentHighlightProvider", true},
          {"documentSymbolProvider", true}, {"workspaceSymbolProvider", true}};
}

} // namespace feedhold::lsp
