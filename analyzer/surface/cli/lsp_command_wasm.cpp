// `feedhold lsp` in WebAssembly: the server works with threads, of which there are none.
#include "surface/cli/commands.h"
#include "surface/cli/terminal.h"

namespace feedhold {

Command addLspCommand(CLI::App &parent) {
  CLI::App *app = parent.add_subcommand("lsp", "run the language server for editors on standard input and output");
  return {app, [] {
            printError("the language server needs threads, which this build does not have");
            return kExitCouldNotRun;
          }};
}

} // namespace feedhold
