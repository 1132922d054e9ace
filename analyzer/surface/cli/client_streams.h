// The client of `feedhold lsp` on standard input and output.  One .cpp for systems with threads, one for those without.
#pragma once

#include "surface/lsp/server.h"

namespace feedhold {

/// Until the client is gone; the exit code.
int serveClient(const lsp::ServerOptions &options);

} // namespace feedhold
