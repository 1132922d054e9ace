// CommandTable: what the command line knows, as data for shell completions and the manual page.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace feedhold {

struct OptionRow {
  std::vector<std::string> names; // `-q`, `--quiet`; of a positional its name
  std::string description;
  bool takesValue = false;
  std::vector<std::string> choices; // of the value; empty: anything
};

struct CommandRow {
  std::string name;
  std::string description;
  std::vector<OptionRow> options;
  std::vector<OptionRow> positionals;
};

/// The program itself, and its sub-commands as they were added.
struct CommandTable {
  CommandRow program;
  std::vector<CommandRow> commands;
};
CommandTable commandTable(CLI::App &app);

} // namespace feedhold
