// Flow: what is known before the blocks of a document, for all inputs.  Following it takes longer than anything else
// that is answered here, so that it is kept.
#pragma once

#include "findings/session/ranges.h"

#include <functional>
#include <memory>
#include <optional>

namespace feedhold::lsp {

class Flow {
public:
  using Programs = std::shared_ptr<const Project>;
  using States = std::shared_ptr<const BlockStates>;

  /// Of all blocks of the document, followed when they are first asked for; null when they could not be.
  const BlockStates *statesOf(const Programs &programs);
  /// The same for what is asked with every change of a text: null, too, as long as another thread is at it.
  const BlockStates *statesSoon(const Programs &programs);
  /// Its text is another one.
  void forget();

  /// Has another thread follow(), and take() called with what comes of it.  Empty: all is followed at once.
  std::function<void(const Programs &)> followLater;
  /// Null: they could not be.  From any thread.
  static States follow(const Project &programs);
  void take(const Programs &programs, States states);

private:
  bool isKnown(const Programs &programs) const { return programs_.lock() == programs; }

  std::weak_ptr<const Project> programs_;
  States states_;
  std::weak_ptr<const Project> awaited_; // of what another thread follows
};

} // namespace feedhold::lsp
