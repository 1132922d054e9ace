// Cancelling a proof whose result is no longer needed, for example because the text in the editor has changed.
#pragma once

#include "base/support/process.h"

#include <stop_token>

namespace feedhold::prove {

/// Thrown out of prove() on a thread with a StopScope, soon after its stop was requested.
struct Cancelled {};

/// Lets the proofs of this thread end early while it lives.
class StopScope {
public:
  explicit StopScope(const std::stop_token &stop);
  ~StopScope();
  StopScope(const StopScope &) = delete;
  StopScope &operator=(const StopScope &) = delete;

private:
  const std::stop_token *outer_;
  ChildrenStop children_; // solvers among them
};

/// Called wherever work that takes long begins.
void throwIfCancelled();

} // namespace feedhold::prove
