// Mutants: a program with one slip in it, of the kinds that people make.
#pragma once

#include "soundness/macro_programs.h"

namespace feedhold::mutation {

struct Mutant {
  std::string_view slip;
  std::size_t line; // which of the lines has it
  soundness::ProgramLines lines;
};

/// Of the first program of the lines and of its contract; what is called stays as it is.
std::vector<Mutant> mutantsOf(const soundness::ProgramLines &lines);

/// Of all programs of the lines, slips in movements as well; the contracts stay as they are.
std::vector<Mutant> movingMutantsOf(const soundness::ProgramLines &lines);

} // namespace feedhold::mutation
