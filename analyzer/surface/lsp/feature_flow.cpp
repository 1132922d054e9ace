#include "surface/lsp/feature_flow.h"

namespace feedhold::lsp {

const BlockStates *Flow::statesOf(const Programs &programs) {
  if (!isKnown(programs))
    take(programs, follow(*programs));
  return states_.get();
}

const BlockStates *Flow::statesSoon(const Programs &programs) {
  if (isKnown(programs) || !followLater)
    return statesOf(programs);
  if (awaited_.lock() != programs) {
    awaited_ = programs;
    followLater(programs);
  }
  return nullptr;
}

void Flow::forget() {
  states_.reset();
  programs_.reset();
  awaited_.reset();
}

Flow::States Flow::follow(const Project &programs) {
  Result<BlockStates> states = rangesOf(programs, {});
  if (!states || states.value().gaveUp)
    return nullptr;
  return std::make_shared<const BlockStates>(states.take());
}

void Flow::take(const Programs &programs, States states) {
  programs_ = programs;
  states_ = std::move(states);
}

} // namespace feedhold::lsp
