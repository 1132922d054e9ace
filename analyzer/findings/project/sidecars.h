// Sidecars: the files beside a program that hold contracts.
#pragma once

#include "findings/project/open_texts.h"
#include "language/contract/contract.h"

#include <filesystem>
#include <vector>

namespace feedhold {

/// The names that the sidecars of a program file have, whether they are there or not.
std::vector<std::filesystem::path> sidecarNames(const std::filesystem::path &file, const ProgramModel &model);
/// The same of the programs that it calls by their numbers, which need not be in any file.
std::vector<std::filesystem::path> sidecarNamesOfCalled(const std::filesystem::path &file, const ProgramModel &model);
/// `part.contract`
bool isSidecarName(const std::filesystem::path &file);

/// Of `part.nc`: `O9100.contract` for each of its programs, then `part.contract` and `part.nc.contract`; last the
/// nearest `machine.contract`, the set-up.  One that is there and cannot be read is in the list with the reason.
std::vector<Sidecar> sidecarsOf(const std::filesystem::path &file, const ProgramModel &model,
                                const std::shared_ptr<const OpenTexts> &open);

} // namespace feedhold
