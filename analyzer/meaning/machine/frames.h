// Frames: the programs that a run has entered and not left, and whether a whole state of a run comes back.
#pragma once

#include "meaning/machine/concrete_reading.h"

#include <memory>
#include <optional>
#include <vector>

namespace feedhold {

struct Frame {
  Callee callee;
  Place call;             // the node that called; of the first frame, where the run began
  double repeatsLeft = 1; // of L, this pass included
  bool ownLocals = false;
  std::array<ConcreteValue, kLocalVariables + 1> callerLocals = {}; // of ownLocals, as the next one
  std::vector<VariableMap<ConcreteValue>::Entry> callerNames = {};  // named variables that only the caller sees
  std::vector<std::pair<std::uint8_t, bool>> callerLoops = {};      // as entered in the caller
  std::optional<std::size_t> modal = {};      // the modal call that this is: its index in MachineState::modalCalls
  std::optional<std::size_t> modalLimit = {}; // only modal calls below this one apply inside; absent: all

  friend bool operator==(const Frame &a, const Frame &b) {
    return a.call == b.call && a.repeatsLeft == b.repeatsLeft && a.callerLocals == b.callerLocals &&
           a.callerNames == b.callerNames && a.callerLoops == b.callerLoops && a.modal == b.modal &&
           a.modalLimit == b.modalLimit;
  }
};

/// A run whose whole state comes back at a place goes on for ever.  Brent's method: one state is kept, and replaced
/// after twice as many visits as the last one, so that a cycle of any length is met.
class RepeatWatch {
public:
  enum class Outside : std::uint8_t { Unread, Read };
  /// `outside`: whether an input or a clock has been read since the last visit; it may differ the next time.
  bool comesBack(Place place, const MachineState<ConcreteReading> &state, const std::vector<Frame> &frames,
                 Outside outside);

private:
  struct Kept {
    Place place;
    MachineState<ConcreteReading> state;
    std::vector<Frame> frames;
  };
  std::unique_ptr<const Kept> kept_;
  std::uint64_t visits_ = 0;
  std::uint64_t next_ = 64;
};

} // namespace feedhold
