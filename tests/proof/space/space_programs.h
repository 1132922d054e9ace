// Random milling programs with a contract of their arguments, start, codes and tool: what claims about space are tried
// on.
#pragma once

#include "soundness/macro_programs.h"

namespace feedhold::proof_tests {

/// Nothing is said of space yet.
soundness::Sample millingProgram(soundness::Random &random);
/// One movement by plain numbers.
soundness::Sample oneMovement(soundness::Random &random);

} // namespace feedhold::proof_tests
