// Flow: what is known before the blocks of a document, for all inputs.  Following it takes longer than anything else
// that is answered here, so that it is kept.
#pragma once

#include "findings/session/ranges.h"

#include <memory>
#include <optional>

namespace feedhold::lsp {

class Flow {
public:
  /// Of all blocks of the document, followed when they are first asked for; null when they could not be.
  const BlockStates *statesOf(const std::shared_ptr<const LoadedPrograms> &programs);
  /// Its text is another one.
  void forget();

private:
  std::weak_ptr<const LoadedPrograms> programs_;
  std::optional<BlockStates> states_;
};

} // namespace feedhold::lsp
