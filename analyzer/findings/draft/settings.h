// Settings: common variables that one single place in a folder sets, to a number: `#501=12.(DIAMETER)`.  The place is
// in a program that moves nothing, or in one that calls the reader.
#pragma once

#include "findings/project/project.h"

#include <string>
#include <vector>

namespace feedhold::draft {

struct Setting {
  std::uint32_t variable;
  Decimal value;
  std::string program; // that sets it: `O8000`
  std::uint32_t line;
};

/// Those that the program reads and does not write, by number.
std::vector<Setting> settingsOf(const Project &project, ProgramId program);
/// `12 in O8000 (line 4)`
std::string toldOf(const Setting &setting);

} // namespace feedhold::draft
