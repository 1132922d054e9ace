// The manual page as roff, for `man`.
#pragma once

#include "surface/cli/command_table.h"

#include <string>

namespace feedhold {

std::string manPage(const CommandTable &table, std::string_view version);

} // namespace feedhold
