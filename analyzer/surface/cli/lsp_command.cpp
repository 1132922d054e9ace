// `feedhold lsp`: the language server on standard input and output.
#include "dialects/registry.h"
#include "rules/registry.h"
#include "surface/cli/cache_place.h"
#include "surface/cli/commands.h"
#include "surface/lsp/server.h"

#include <iostream>
#include <memory>

namespace feedhold {

namespace {

struct LspArguments {
  std::string cacheFolder;
  std::string clientProcess;
  bool stdio = false;
  bool withoutCache = false;
};

int runLsp(const LspArguments &arguments) {
  const std::optional<std::filesystem::path> folder =
      arguments.cacheFolder.empty() ? std::nullopt : std::optional<std::filesystem::path>(arguments.cacheFolder);
  lsp::ServerOptions options{
      .known = {allDialects(), allRules()}, .version = FEEDHOLD_VERSION, .cache = std::nullopt, .pages = std::nullopt};
  if (!arguments.withoutCache)
    options.cache = proofCache(folder);
  if (options.cache)
    options.pages = std::filesystem::absolute(options.cache->folder) / "pages" / FEEDHOLD_VERSION;
  std::ios::sync_with_stdio(false); // a stream with a buffer reads bodies in one piece
  std::cin.tie(nullptr);            // reading would write what waits in cout, from a thread that does not hold its lock
  return lsp::serve(std::cin, std::cout, options);
}

} // namespace

Command addLspCommand(CLI::App &parent) {
  CLI::App *app = parent.add_subcommand("lsp", "run the language server for editors, on standard input and output");
  const auto arguments = std::make_shared<LspArguments>();
  app->add_flag("--stdio", arguments->stdio, "the only way to speak to it; editors like to say so");
  app->add_option("--clientProcessId", arguments->clientProcess, "taken because editors pass it");
  CLI::Option *cache =
      app->add_option("--cache-dir", arguments->cacheFolder, "keep verdicts here (default: the cache of the user)");
  app->add_flag("--no-cache", arguments->withoutCache, "keep nothing on disk")->excludes(cache);
  return {app, [arguments] { return runLsp(*arguments); }};
}

} // namespace feedhold
