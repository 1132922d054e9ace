// `--only KIND`: which obligations `prove` and `certify` look at.
#pragma once

#include "proof/obligation/obligation.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace feedhold {

void addOnlyKinds(CLI::App &app, std::vector<std::string> &names);
/// None: all of them.
std::vector<prove::ObligationKind> kindsFrom(const std::vector<std::string> &names);

} // namespace feedhold
