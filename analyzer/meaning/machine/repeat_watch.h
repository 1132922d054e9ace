// RepeatWatch: whether a whole state of a run comes back.
#pragma once

#include "meaning/machine/concrete_interpretation.h"
#include "meaning/semantics/frames.h"

#include <memory>
#include <vector>

namespace feedhold {

using ConcreteFrame = Frame<ConcreteInterpretation>;

/// A run whose whole state comes back at a place goes on for ever.  Brent's method: one state is kept, and replaced
/// after twice as many visits as the last one, so that a cycle of any length is met.
class RepeatWatch {
public:
  enum class Outside : std::uint8_t { Unread, Read };
  /// `outside`: whether an input or a clock has been read since the last visit; it may differ the next time.
  bool comesBack(Place place, const MachineState<ConcreteInterpretation> &state,
                 const std::vector<ConcreteFrame> &frames, Outside outside);

private:
  struct Kept {
    Place place;
    MachineState<ConcreteInterpretation> state;
    std::vector<ConcreteFrame> frames;
  };
  std::unique_ptr<const Kept> kept_;
  std::uint64_t visits_ = 0;
  std::uint64_t next_ = 64;
};

} // namespace feedhold
