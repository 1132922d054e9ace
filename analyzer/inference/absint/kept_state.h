// KeptState: a state in little room: what differs from another one.
//
// From one block to the next few of some two hundred values change.
#pragma once

#include "inference/absint/abstract_state.h"

#include <memory>
#include <optional>
#include <vector>

namespace feedhold {

class KeptState {
public:
  AbstractState state() const;
  CodeSet code(std::uint8_t group) const;
  /// That are kept for this state alone.
  std::size_t valueCount() const { return cells_.size() + variables_.size() + ownValues_; }

private:
  friend class StateKeeper;

  struct Cell {
    std::uint32_t index; // among all values but the variables, in the order of forEachPart
    AbstractValue value;
  };
  /// What is no value, in the order of forEachPart; nearly always that of the base.
  struct Rest {
    decltype(AbstractState::havocked) havocked;
    std::vector<std::pair<PartId, CodeSet>> codes;
    std::vector<Truth> truths;
    friend bool operator==(const Rest &, const Rest &) = default;
  };
  static Rest restOf(const AbstractState &state);

  std::shared_ptr<const AbstractState> base_;
  std::vector<Cell> cells_;
  std::vector<VariableMap<AbstractValue>::Entry> variables_; // new or with another value
  std::vector<std::uint32_t> erased_;                        // variables of the base
  std::shared_ptr<const Rest> rest_;
  std::size_t ownValues_ = 0; // of the base, when it was made for this state
};

/// Keeps one state after another.
class StateKeeper {
public:
  KeptState keep(const AbstractState &state);

private:
  std::optional<KeptState> differing(const AbstractState &state) const;

  std::shared_ptr<const AbstractState> base_;
  std::shared_ptr<const KeptState::Rest> rest_;
};

} // namespace feedhold
