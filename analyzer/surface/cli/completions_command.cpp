// `feedhold completions SHELL` and `feedhold man`: what the command line says of itself.
#include "surface/cli/commands.h"
#include "surface/cli/completions.h"
#include "surface/cli/man_page.h"
#include "surface/cli/terminal.h"

#include <memory>

namespace feedhold {

Command addCompletionsCommand(CLI::App &parent) {
  CLI::App *app = parent.add_subcommand("completions", "print a completion script for a shell");
  const auto shell = std::make_shared<std::string>();
  app->add_option("shell", *shell, "shell that the script is for")
      ->type_name("SHELL")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  return {app, [shell, &parent] {
            const CommandTable table = commandTable(parent);
            print(*shell == "bash"  ? bashCompletions(table)
                  : *shell == "zsh" ? zshCompletions(table)
                                    : fishCompletions(table));
            return kExitClean;
          }};
}

Command addManCommand(CLI::App &parent) {
  CLI::App *app = parent.add_subcommand("man", "print the manual page; read it with `feedhold man | man -l -`");
  return {app, [&parent] {
            print(manPage(commandTable(parent), FEEDHOLD_VERSION));
            return kExitClean;
          }};
}

} // namespace feedhold
