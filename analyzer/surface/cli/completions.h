// Completions: scripts that complete the command line in a shell.
#pragma once

#include "surface/cli/command_table.h"

#include <string>

namespace feedhold {

std::string bashCompletions(const CommandTable &table);
std::string zshCompletions(const CommandTable &table);
std::string fishCompletions(const CommandTable &table);

} // namespace feedhold
