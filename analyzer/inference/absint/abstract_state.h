// AbstractState: the lattice of machine states: entry states, order, join and widening.
#pragma once

#include "inference/absint/abstract_reading.h"

#include <span>

namespace feedhold {

/// What the control gives to a program that is started: variables, modal state and position are whatever they were, each
/// a symbol of its own.
AbstractState entryState(AbstractReading &reading);

/// Calls visit(AbstractValue &) for every value of a state, in a fixed order; two states that have been aligned have
/// the same values at the same places.
template <typename State, typename Visit> void forEachValue(State &state, Visit &&visit);

/// Gives both states the same list of variables.
void align(const AbstractReading &reading, AbstractState &a, AbstractState &b);

/// Every run that `a` describes is described by `b`.  Symbols other than those of the entry may have other names.
bool leq(const AbstractReading &reading, const AbstractState &a, const AbstractState &b);

/// Distances that hold in both hold in the join.
void joinInto(AbstractReading &reading, AbstractState &state, const AbstractState &other);

/// `thresholds` ascend.
void widenInto(AbstractReading &reading, AbstractState &old, const AbstractState &next,
               std::span<const double> thresholds);

// ---- template -----------------------------------------------------------------------------------------------------

template <typename State, typename Visit> void forEachValue(State &state, Visit &&visit) {
  const auto all = [&visit](auto &values) {
    for (auto &value : values)
      visit(value);
  };
  all(state.locals);
  for (auto &entry : state.variables.entries())
    visit(entry.second);
  all(state.position);
  all(state.words);
  all(state.shift);
  all(state.local);
  visit(state.lengthOffset);
  visit(state.cycle.bottom);
  visit(state.cycle.retract);
  visit(state.cycle.initial);
  visit(state.cycle.peck);
  visit(state.cycle.dwell);
  all(state.transform.scale);
  all(state.transform.scaleCentre);
  all(state.transform.mirrorAt);
  visit(state.transform.angle);
  all(state.transform.centre);
  visit(state.transform.other);
  for (auto &call : state.modalCalls) {
    visit(call.repeats);
    all(call.locals);
  }
  all(state.counters);
}

} // namespace feedhold
