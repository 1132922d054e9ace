// Arguments: what a program takes, and the macro call at a place.
#pragma once

#include "surface/lsp/feature_json.h"

#include <string>
#include <vector>

namespace feedhold::lsp {

struct Parameter {
  char letter;
  std::uint32_t variable;
  std::string name;   // may be empty
  std::string clause; // of the contract; may be empty
};
/// By the contract of the program; without one the local variables with a letter that it reads.  In order of letters.
std::vector<Parameter> parametersOf(const Project &programs, ProgramRef program);

/// The macro call in the block of an offset whose code stands before it, and the program that it reaches.
struct CallAtPlace {
  const Call *call;
  ProgramRef callee;
};
std::optional<CallAtPlace> macroCallAt(const Project &programs, std::uint32_t offset);

} // namespace feedhold::lsp
