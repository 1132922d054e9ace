#include "proof/decide/cancel.h"

#include "base/support/turns.h"

#include <utility>

namespace feedhold::prove {

namespace {

thread_local const std::stop_token *current = nullptr;

} // namespace

StopScope::StopScope(const std::stop_token &stop) : outer_(current), children_(stop) { current = &stop; }
StopScope::~StopScope() { current = outer_; }

void throwIfCancelled() {
  // Without threads, only others can ask for the stop; it does not concern what they do themselves.
  const std::stop_token *const own = std::exchange(current, nullptr);
  giveTurn();
  current = own;
  if (current != nullptr && current->stop_requested())
    throw Cancelled{};
}

} // namespace feedhold::prove
