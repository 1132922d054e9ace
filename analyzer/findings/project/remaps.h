// Remaps: the G and M codes that the `.ini` file of a machine redefines (LinuxCNC, "Remap: Extending G-code"):
// `REMAP=M462 modalgroup=10 argspec=P ngc=probe` in the section [RS274NGC].
#pragma once

#include "language/dialect/dialect.h"

#include <filesystem>
#include <map>
#include <vector>

namespace feedhold {

/// `.ini`
bool isRemapFileName(const std::filesystem::path &path);

/// Reads the `.ini` files of each folder once.
class RemapFinder {
public:
  /// Of all `.ini` files in these folders, sorted, each once: which of several a machine is started with is not known.
  std::vector<CodeName> inFolders(const std::vector<std::filesystem::path> &folders);

private:
  std::map<std::filesystem::path, std::vector<CodeName>> byFolder_;
};

} // namespace feedhold
