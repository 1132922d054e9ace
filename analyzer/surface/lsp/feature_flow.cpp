#include "surface/lsp/feature_flow.h"

namespace feedhold::lsp {

const BlockStates *Flow::statesOf(const std::shared_ptr<const LoadedPrograms> &programs) {
  if (programs_.lock() != programs) {
    forget();
    if (Result<BlockStates> states = rangesOf(*programs, {}))
      states_ = states.take();
    programs_ = programs;
  }
  return states_ && !states_->gaveUp ? &*states_ : nullptr;
}

void Flow::forget() {
  states_.reset();
  programs_.reset();
}

} // namespace feedhold::lsp
