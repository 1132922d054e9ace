#include "meaning/machine/repeat_watch.h"

namespace feedhold {

bool RepeatWatch::comesBack(Place place, const MachineState<ConcreteInterpretation> &state,
                            const std::vector<ConcreteFrame> &frames, Outside outside) {
  if (outside == Outside::Read)
    kept_.reset();
  if (kept_ && kept_->place == place && kept_->frames == frames && kept_->state == state)
    return true;
  if (++visits_ < next_)
    return false;
  next_ *= 2;
  kept_ = std::make_unique<const Kept>(Kept{place, state, frames});
  return false;
}

} // namespace feedhold
