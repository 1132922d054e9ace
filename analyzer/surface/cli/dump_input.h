// What `tokens`, `tree`, `model` and `cfg` have in common: one file and its dialect.
#pragma once

#include "base/source/source_file.h"
#include "language/dialect/dialect.h"
#include "surface/cli/commands.h"

#include <functional>
#include <string>

namespace feedhold {

/// Adds a sub-command that reads one file (or `-`) and prints what `dump` makes of it.
Command addDumpCommand(CLI::App &parent, const std::string &name, const std::string &description,
                       std::string (*dump)(const SourceFile &, const Dialect &));

} // namespace feedhold
