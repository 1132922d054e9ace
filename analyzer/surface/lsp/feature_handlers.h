// The handlers, one file for each group of requests.
#pragma once

#include "surface/lsp/feature.h"

namespace feedhold::lsp {

Json hover(const View &view, const Json &params);
Json definition(const View &view, const Json &params);
Json references(const View &view, const Json &params);
Json documentHighlight(const View &view, const Json &params);
Json prepareRename(const View &view, const Json &params);
Json rename(const View &view, const Json &params);
/// `feedhold/renumber`: a WorkspaceEdit that numbers the blocks of the document anew, `params.step` (10) apart.
Json renumber(const View &view, const Json &params);
Json documentSymbol(const View &view, const Json &params);
Json workspaceSymbol(const View &view, const Json &params);
Json prepareCallHierarchy(const View &view, const Json &params);
Json incomingCalls(const View &view, const Json &params);
Json outgoingCalls(const View &view, const Json &params);
Json foldingRange(const View &view, const Json &params);
Json semanticTokens(const View &view, const Json &params);
Json semanticTokensLegend();
Json inlayHint(const View &view, const Json &params);
Json completion(const View &view, const Json &params);
Json signatureHelp(const View &view, const Json &params);
Json codeLens(const View &view, const Json &params);

} // namespace feedhold::lsp
