// Exact runs: what a run on given inputs comes to in exact numbers, where the machine computes with doubles.
#pragma once

#include "meaning/machine/machine.h"
#include "proof/prove/exploration.h"

namespace feedhold::prove {

enum class Agreement : std::uint8_t {
  Same,      // the exact run ends there, too
  Different, // it does not
  NotKnown,  // it was too long to follow, or something in it has no exact value
};

/// To follow single runs.
ExploreOptions exactOptions();
/// The reading starts from these inputs.
void startExactly(SymbolicReading &reading, const GivenVariables &given);

/// Whether the run on these inputs also ends in exact numbers as the machine's run ended.
Agreement agreesExactly(const ProgramSet &programs, Callee entry, const GivenVariables &given, const RunResult &run);

} // namespace feedhold::prove
