// Packages: the programs of corpus/packages/ of which the manifest says that all is proved.
#pragma once

#include "soundness/macro_programs.h"

#include <string>
#include <vector>

namespace feedhold::mutation {

struct PackageText {
  std::string package;           // `pocket`
  std::string name;              // `pocket/O9311`
  std::string dialect;           // its id
  soundness::ProgramLines lines; // with what it calls behind it
};

/// In the order of the manifest.
std::vector<PackageText> provedPackages();

soundness::ProgramLines linesOf(const std::string &path);

} // namespace feedhold::mutation
