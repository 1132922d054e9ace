// Containment: whether a state of a run lies in an abstract state.
#pragma once

#include "inference/absint/abstract_state.h"
#include "meaning/machine/machine.h"

#include <optional>
#include <string>

namespace feedhold::soundness {

/// What the run started with: the values that entry symbols and "as at entry" stand for.
struct EntryValues {
  MachineState<ConcreteInterpretation> state;
  GivenVariables given;
  NumberModel numbers = NumberModel::Binary64;
};

/// Absent when it does; else the first thing that does not.
std::optional<std::string> whyOutside(const MachineState<ConcreteInterpretation> &state, const AbstractState &abstract,
                                      const EntryValues &entry, const ModalTable &modes, const Dialect &dialect);

/// Some number has left the range that any control computes in.
bool overflows(const MachineState<ConcreteInterpretation> &state);

} // namespace feedhold::soundness
