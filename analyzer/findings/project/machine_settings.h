// What the programs of a folder give away about the settings of their machine, where the configuration leaves them
// open.  Rules allow for it; `run`, `ranges` and `prove` do not, since programs are no proof of a parameter.
#pragma once

#include "findings/project/project_file.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace feedhold {

struct InferredSetting {
  std::string folder; // as shown; empty: the current one
  std::string_view dialect;
  std::string table;    // of feedhold.toml: "switches"; empty: the line stands at its head
  std::string line;     // `dpi = true`
  std::string evidence; // "412 of 430 lengths have no decimal point"
};

/// The files of one folder and one dialect are those of one machine.  Gives them a dialect with the settings that
/// they show; null files are passed over.  One result for each setting of each machine, by folder.
std::vector<InferredSetting> inferMachineSettings(std::span<const std::shared_ptr<ProjectFile>> files);

} // namespace feedhold
