// Mutants: a program with one slip in it, of the kinds that people make.
#pragma once

#include "soundness/macro_programs.h"

namespace feedhold::mutation {

struct Mutant {
  std::string_view slip;
  soundness::ProgramLines lines;
};

/// Of the first program of the lines; what is called stays as it is.
std::vector<Mutant> mutantsOf(const soundness::ProgramLines &lines);

} // namespace feedhold::mutation
