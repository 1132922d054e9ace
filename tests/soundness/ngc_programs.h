// Random programs in the language of LinuxCNC: o-words, named parameters, calls with arguments.
#pragma once

#include "soundness/macro_programs.h"

namespace feedhold::soundness {

/// The subroutines stand before the main program, as the interpreter wants them.
ProgramLines ngcProgram(Random &random);

} // namespace feedhold::soundness
