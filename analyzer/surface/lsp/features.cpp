#include "surface/lsp/feature_handlers.h"

#include <array>

namespace feedhold::lsp {

namespace {

constexpr std::array kFeatures{
    Feature{"textDocument/hover", hover},
    Feature{"textDocument/inlayHint", inlayHint},
    Feature{"textDocument/definition", definition},
    Feature{"textDocument/references", references},
    Feature{"textDocument/documentHighlight", documentHighlight},
    Feature{"textDocument/prepareRename", prepareRename},
    Feature{"textDocument/rename", rename},
    Feature{"feedhold/renumber", renumber},
    Feature{"textDocument/documentSymbol", documentSymbol},
    Feature{"workspace/symbol", workspaceSymbol},
    Feature{"textDocument/prepareCallHierarchy", prepareCallHierarchy},
    Feature{"callHierarchy/incomingCalls", incomingCalls},
    Feature{"callHierarchy/outgoingCalls", outgoingCalls},
    Feature{"textDocument/foldingRange", foldingRange},
    Feature{"textDocument/semanticTokens/full", semanticTokens},
    Feature{"textDocument/completion", completion},
    Feature{"textDocument/signatureHelp", signatureHelp},
    Feature{"textDocument/codeLens", codeLens},
};

} // namespace

std::span<const Feature> features() { return kFeatures; }

Json featureCapabilities() {
  return {{"hoverProvider", true},
          {"inlayHintProvider", true},
          {"definitionProvider", true},
          {"referencesProvider", true},
          {"documentHighlightProvider", true},
          {"renameProvider", {{"prepareProvider", true}}},
          {"documentSymbolProvider", true},
          {"workspaceSymbolProvider", true},
          {"callHierarchyProvider", true},
          {"foldingRangeProvider", true},
          {"semanticTokensProvider", {{"legend", semanticTokensLegend()}, {"full", true}}},
          {"completionProvider", {{"triggerCharacters", {"#", "P", "@", "O", " "}}}},
          {"signatureHelpProvider", {{"triggerCharacters", {" "}}}},
          {"codeLensProvider", {{"resolveProvider", false}}}};
}

} // namespace feedhold::lsp
