// serve: the language server on a pair of streams.
#pragma once

#include "findings/project/config.h"
#include "findings/session/proof_cache.h"

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

} // namespace feedhold::lsp
