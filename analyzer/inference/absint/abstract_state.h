// AbstractState: the lattice of machine states: entry states, order, join and widening.
#pragma once

#include "inference/absint/abstract_interpretation.h"
#include "meaning/semantics/parts.h"

#include <span>

namespace feedhold {

/// What the control gives to a program that is started: variables, modal state and position are whatever they were,
/// each a symbol of its own.
AbstractState entryState(AbstractInterpretation &interpretation);

/// Every run that `a` describes is described by `b`.  Symbols other than those of the entry may have other names.
bool leq(const AbstractInterpretation &interpretation, const AbstractState &a, const AbstractState &b);

/// Distances that hold in both hold in the join.
void joinInto(AbstractInterpretation &interpretation, AbstractState &state, const AbstractState &other);

/// `thresholds` ascend.
void widenInto(AbstractInterpretation &interpretation, AbstractState &old, const AbstractState &next,
               std::span<const double> thresholds);

} // namespace feedhold
