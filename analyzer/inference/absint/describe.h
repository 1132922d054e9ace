// Describe: abstract values and states in words and signs that a machinist can read.
#pragma once

#include "inference/absint/abstract_state.h"

#include <string>
#include <vector>

namespace feedhold {

/// `vacant`, `3`, `0 to 17 in steps of 0.25`, `any number`, `vacant or 1 to 3`.
std::string describe(const AbstractValue &value);

/// What is known of one thing.
struct StateFact {
  std::string name;  // `#1`, `X`, `G90/G91`
  std::string value; // as describe() says it
  std::string relation; // `= entry #1 + 5`, `= #10 - 17`; may be empty
};

struct StateDescription {
  std::vector<StateFact> variables; // those of which something is known
  std::vector<StateFact> positions;
  std::vector<StateFact> modes;
};
StateDescription describe(const AbstractState &state, const ModalTable &modes, const ProgramSet &programs);

} // namespace feedhold
