// `feedhold lsp`: the language server on standard input and output.
#include "base/source/path_text.h"
#include "dialects/registry.h"
#include "rules/registry.h"
#include "surface/cli/cache_place.h"
#include "surface/cli/client_streams.h"
#include "surface/cli/commands.h"
#include "surface/cli/shared_options.h"
#include "surface/cli/terminal.h"

#include <memory>

namespace feedhold {

namespace {

struct LspArguments {
  CacheArguments cache;
  std::string clientProcess;
  bool stdio = false;
};

int runLsp(const LspArguments &arguments) {
  const std::optional<std::filesystem::path> folder =
      arguments.cache.folder.empty() ? std::nullopt : std::optional<std::filesystem::path>(arguments.cache.folder);
  lsp::ServerOptions options{
      .known = {allDialects(), allRules()}, .version = FEEDHOLD_VERSION, .cache = std::nullopt, .pages = std::nullopt};
  if (!arguments.cache.off) {
    Result<std::optional<ProofCache>> cache = proofCache(folder, arguments.cache.url);
    if (!cache) {
      printError(cache.error().message);
      return kExitCouldNotRun;
    }
    options.cache = cache.take();
  }
  if (options.cache)
    options.pages = absolutePath(options.cache->folder) / "pages" / FEEDHOLD_VERSION;
  return serveClient(options);
}

} // namespace

Command addLspCommand(CLI::App &parent) {
  CLI::App *app = parent.add_subcommand("lsp", "run the language server for editors on standard input and output");
  const auto arguments = std::make_shared<LspArguments>();
  app->add_flag("--stdio", arguments->stdio, "accepted for editors; the server always uses standard input and output");
  app->add_option("--clientProcessId", arguments->clientProcess, "accepted for editors, and ignored")->type_name("PID");
  addCache(*app, arguments->cache);
  return {app, [arguments] { return runLsp(*arguments); }};
}

} // namespace feedhold
