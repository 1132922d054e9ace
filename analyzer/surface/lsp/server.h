// serve: the language server on a pair of streams.
#pragma once

#include "findings/project/config.h"
#include "findings/session/proof_cache.h"

#include <chrono>
#include <functional>
#include <istream>
#include <optional>
#include <ostream>
#include <string>

namespace feedhold::lsp {

struct ServerOptions {
  KnownNames known;
  std::string version;
  std::optional<ProofCache> cache;            // of verdicts
  std::optional<std::filesystem::path> pages; // a folder for the pages of rules, to which diagnostics lead
};

/// Until the client says `exit`, or is gone.  The exit code that the protocol asks for: 0 after `shutdown`, else 1.
/// Nothing else may be written to `out`.
int serve(std::istream &in, std::ostream &out, const ServerOptions &options);

/// Whether something of the client, or its end, has come; if not, waits for it until then, or without an end.
using HasCome = std::function<bool(std::optional<std::chrono::steady_clock::time_point> until)>;

/// As serve(), where there are no threads: whatever takes long gives turns to what comes meanwhile.
int serveWithoutThreads(std::istream &in, std::ostream &out, const ServerOptions &options, const HasCome &hasCome);

} // namespace feedhold::lsp
