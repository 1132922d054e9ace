// The handlers, one file for each group of requests.
#pragma once

#include "surface/lsp/feature.h"

namespace feedhold::lsp {

Json hover(const View &view, const Json &params);
Json definition(const View &view, const Json &params);
Json references(const View &view, const Json &params);
Json documentHighlight(const View &view, const Json &params);
Json documentSymbol(const View &view, const Json &params);
Json workspaceSymbol(const View &view, const Json &params);

} // namespace feedhold::lsp
