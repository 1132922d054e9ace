// Contracts of programs that are called and are in none of the files: `O9800.contract` in the folder of the callers.
#pragma once

#include "findings/project/project_file.h"

#include <map>
#include <memory>
#include <span>

namespace feedhold {

/// By number; each holds the contract of ProgramId(0), with the set-up of the machine.
using MissingContracts = std::map<std::uint32_t, std::shared_ptr<const FileContracts>>;

/// Of the programs that the files call by their numbers.  `folder`: that of all files.
MissingContracts missingContracts(std::span<const std::shared_ptr<const ProjectFile>> files,
                                  const std::filesystem::path &folder, const std::shared_ptr<const OpenTexts> &open);

} // namespace feedhold
