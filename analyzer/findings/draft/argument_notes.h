// Argument notes: what the comments of programs call their variables, and in which units.
#pragma once

#include "findings/project/project.h"

#include <map>
#include <string>

namespace feedhold::draft {

struct ArgumentNote {
  std::string name; // as `@PARAM` takes it; may be empty
  std::string unit; // `MM/MIN`; may be empty
};
using ArgumentNotes = std::map<std::uint32_t, ArgumentNote>;

/// `(Z - DRILLING DEPTH)`, `(#26: DEPTH, MM)` in the program, and `#501=12. (DIAMETER)` in any file of its folder.
ArgumentNotes argumentNotes(const Project &project, ProgramId program);

/// Callers as the text shows them: what is passed in a variable.
struct PassedArgument {
  std::size_t calls = 0;            // of the program, in the files of the project
  std::size_t passing = 0;          // of those, that pass it
  std::vector<Decimal> values = {}; // that are written as numbers; each once, ascending
  bool isComputedSomewhere = false; // some are not
};
PassedArgument passedIn(const Project &project, ProgramId program, std::uint32_t variable);
/// `2 calls pass 0.5, 3`; empty: no call is known.
std::string toldOf(const PassedArgument &passed);

/// The letter that passes a local variable.
std::optional<char> letterOf(const Dialect &dialect, std::uint32_t variable);

} // namespace feedhold::draft
